/* Goal: the end of a trial is shown with its outcome: kept, given up, run out, cut short. */
import { describe, expect, it } from 'vitest'
import type { Device } from '../api/types'
import { endOf, isOver, secondsLeft, trialOf, type Trial } from './trial'

const NOW_MS = Date.parse('2026-11-21T10:00:00Z')
const LEFT_S = 30
const TRIED = 222
const BEFORE = 111

type Cause = 'asked' | 'time_out' | 'restart' | null

function unit(crc32: number, state: 'committed' | 'provisional', cause: Cause = null): Device {
  const remaining_s = state === 'provisional' ? LEFT_S : null
  const config = { generation: 8, crc32, state, remaining_s, rollback_cause: cause }
  return { id: 'unit', unit_key: 'ebl:11', state: 'ready', config } as unknown as Device
}

const trial = trialOf(unit(TRIED, 'provisional'), NOW_MS) as Trial

it('counts down what the unit has left, whatever the clocks say, and not below zero', () => {
  expect(secondsLeft(trial, NOW_MS + 600)).toBe(LEFT_S)
  expect(secondsLeft(trial, NOW_MS + 35_000)).toBe(0)
})

it('is not over while the unit is away, nor because another unit has none', () => {
  expect(isOver(trial, { ...unit(BEFORE, 'committed'), state: 'lost' })).toBe(false)
  expect(isOver(trial, { ...unit(BEFORE, 'committed', 'asked'), unit_key: 'ebl:22' })).toBe(false)
  expect(isOver(trial, unit(BEFORE, 'committed', 'asked'))).toBe(true)
})

it('is not over before the unit has reported why, and over at once when it was kept', () => {
  expect(isOver(trial, unit(BEFORE, 'committed', null))).toBe(false)
  expect(isOver(trial, unit(TRIED, 'committed', null))).toBe(true)
})

describe('what became of it', () => {
  it('was kept when its content stays', () => {
    expect(endOf(trial, unit(TRIED, 'committed'))).toBe('kept')
  })
  it.each(['asked', 'time_out', 'restart'] as const)('was given up: %s', (cause) => {
    expect(endOf(trial, unit(BEFORE, 'committed', cause))).toBe(cause)
  })
  it('is not guessed when the unit does not say', () => {
    expect(endOf(trial, unit(BEFORE, 'committed'))).toBe('unknown')
  })
})

/* Goal: whoever sees a trial end is told what became of it: kept, given up, run out, cut short. */
import { describe, expect, it } from 'vitest'
import { endOf, isOver, secondsLeft, trialOf, type Trial } from './trial'
import type { Device, Revision } from './types'

const ENDS = '2026-11-21T10:00:30Z'
const ENDS_MS = Date.parse(ENDS)
const TRIED = 222
const BEFORE = 111

function unit(crc32: number, state: 'committed' | 'provisional', link = 'ready'): Device {
  const expires_at = state === 'provisional' ? ENDS : null
  const config = { generation: 8, crc32, state, expires_at }
  return { id: 'unit', state: link, config } as unknown as Device
}

const revision = (crc32: number, state: string) => ({ crc32, state }) as Revision
const trial = trialOf(unit(TRIED, 'provisional')) as Trial

it('counts down to the moment the unit gave, and not below zero', () => {
  expect(secondsLeft(trial, ENDS_MS - 29_400)).toBe(30)
  expect(secondsLeft(trial, ENDS_MS + 5000)).toBe(0)
})

it('is not over while the unit is away, nor because another unit has none', () => {
  expect(isOver(trial, unit(BEFORE, 'committed', 'lost'))).toBe(false)
  expect(isOver(trial, { ...unit(BEFORE, 'committed'), id: 'other' })).toBe(false)
  expect(isOver(trial, unit(BEFORE, 'committed'))).toBe(true)
})

describe('what became of it', () => {
  const log = [revision(TRIED, 'provisional'), revision(BEFORE, 'verified')]
  const back = unit(BEFORE, 'committed')

  it('was kept when its content stays', () => {
    expect(endOf(trial, unit(TRIED, 'committed'), log, ENDS_MS - 9000)).toBe('kept')
  })
  it('was given up when the return is in the log', () => {
    const returned = [revision(BEFORE, 'verified'), ...log]
    expect(endOf(trial, back, returned, ENDS_MS - 9000)).toBe('reverted')
  })
  it('ran out when its time is over', () => {
    expect(endOf(trial, back, log, ENDS_MS + 300)).toBe('expired')
  })
  it('was cut short when the unit has the old one before that', () => {
    expect(endOf(trial, back, log, ENDS_MS - 9000)).toBe('restarted')
  })
})

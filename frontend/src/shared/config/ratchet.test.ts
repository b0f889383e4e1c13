/* Goal: before anything is written, the page knows which limits only a token brings up again. */
import { expect, it } from 'vitest'
import type { ConfigChange } from '../api/types'
import { cannotBeUndone, isRatchet, ratchetMove } from './ratchet'

const written = (name: string, old: number, to: number) =>
  ({ changed: [{ name, old, new: to }] }) as ConfigChange

it('knows from the registry which limits only go down', () => {
  expect(isRatchet('assist_cutoff_kmh')).toBe(true)
  expect(isRatchet('torque_filter_s')).toBe(false)
  expect(isRatchet('of_a_newer_unit')).toBe(false)
})

it('distinguishes down, up, and no change', () => {
  expect(ratchetMove('assist_cutoff_kmh', 25, 20)).toBe('lowered')
  expect(ratchetMove('assist_cutoff_kmh', 20, 25)).toBe('raised')
  expect(ratchetMove('assist_cutoff_kmh', 20, 20)).toBeNull()
  expect(ratchetMove('torque_filter_s', 0.5, 0.3)).toBeNull()
})

it('offers no way back where the way back needs a token', () => {
  expect(cannotBeUndone(written('assist_cutoff_kmh', 25, 20))).toBe(true)
  expect(cannotBeUndone(written('assist_cutoff_kmh', 20, 25))).toBe(false)
  expect(cannotBeUndone(written('torque_filter_s', 0.5, 0.3))).toBe(false)
})

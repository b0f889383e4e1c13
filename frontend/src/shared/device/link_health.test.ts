/* Goal: every frame the unit built is accounted for once: built = received + lost + dropped. */
import { expect, it } from 'vitest'
import { healthOf } from './link_health'

const counters = (received: number, lost: number, dropped: number) => ({
  balance_built: received + lost + dropped,
  balance_received: received,
  balance_lost: lost,
  balance_dropped: dropped,
})

it('is healthy only when nothing is missing', () => {
  expect(healthOf(counters(1000, 0, 0))?.healthy).toBe(true)
  expect(healthOf(counters(1000, 1, 0))?.healthy).toBe(false)
  expect(healthOf(counters(1000, 0, 1))?.healthy).toBe(false)
})

it('names each part', () => {
  const parts = { built: 1012, received: 1000, lost: 7, dropped: 5, healthy: false }
  expect(healthOf(counters(1000, 7, 5))).toEqual(parts)
})

it("says nothing before the unit's first count", () => {
  expect(healthOf(counters(0, 0, 0))).toBeNull()
  expect(healthOf({ stream_frames: 5 })).toBeNull()
})

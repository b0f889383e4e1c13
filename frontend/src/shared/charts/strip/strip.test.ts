/* Goal: strips have calm axes and move smoothly at the rate of the unit's own time. */
import { expect, it } from 'vitest'
import { niceStep, roundRange } from '$shared/charts/plot_axis'
import { StripClock } from './strip_clock.svelte'

it('keeps its range while the data stay within it, and rounds it where they leave', () => {
  expect(roundRange(0, 0.49, [0, 0.5])).toEqual([0, 0.5])
  expect(roundRange(null, null, [0, 40])).toEqual([0, 40])
  expect(roundRange(-3, 61, [0, 40])).toEqual([-20, 80])
})

it('steps by 1, 2 or 5', () => {
  expect([0.3, 1.2, 3, 7, 12].map(niceStep)).toEqual([0.5, 2, 5, 10, 20])
})

it('follows the newest row without jumping and stops when rows stop', () => {
  const clock = new StripClock()
  clock.advance(0, 100)
  const edges: number[] = []
  // Rows arrive every 50 ms, frames are drawn every 16 ms, for two seconds.
  for (let ms = 16; ms <= 2000; ms += 16) {
    clock.advance(ms, 100 + Math.floor(ms / 50) * 0.05)
    edges.push(clock.edge_s)
  }
  const steps = edges.map((edge, i) => edge - (edges[i - 1] ?? edge))
  expect(Math.min(...steps)).toBeGreaterThanOrEqual(0)
  expect(Math.max(...steps)).toBeLessThan(0.06)
  const frames = clock.frame

  for (let ms = 2016; ms <= 4000; ms += 16) clock.advance(ms, 101.95)

  expect(clock.edge_s).toBeLessThanOrEqual(101.95)
  expect(clock.frame).toBeLessThan(frames + 20)
})

/* Goal: a small line runs from its first to its last second, breaks where unknown, and puts
   nothing in place of what is missing. */
import { expect, it } from 'vitest'
import { sparkPath, topOf } from './spark'

it('runs over the whole width, the top at the top and zero at the bottom', () => {
  expect(sparkPath([0, 5, 10], [0, 50, 100], 100)).toBe('M0.0 39.0h0L100.0 20.0L200.0 1.0')
})

it('breaks at what is missing and begins anew behind it', () => {
  const path = sparkPath([0, 1, 2, 3], [4, null, NaN, 4], 4)

  expect(path).toBe('M0.0 1.0h0M200.0 1.0h0')
})

it('draws nothing of nothing, and a single moment as a point', () => {
  expect(sparkPath([], [], 0)).toBe('')
  expect(sparkPath([3], [0], 0)).toBe('M0.0 39.0h0')
})

it('tops at the largest that is known', () => {
  expect(topOf([1, null, 7], [NaN, 3])).toBe(7)
  expect(topOf([null])).toBeNull()
})

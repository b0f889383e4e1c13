/* Goal: what is drawn stands where its value is, and what is pointed at is what stands there. */
import { expect, it } from 'vitest'
import { nearestTo, pixelOf, roundTicks } from './plot_axis'

const axis = { low: 0, high: 25, from_px: 100, to_px: 600 } // 20 px for each unit

it('places a value by its share, and holds what is beyond at the end', () => {
  expect(pixelOf(axis, 10)).toBe(300)
  expect(pixelOf(axis, -4)).toBe(100)
  expect(pixelOf(axis, 60)).toBe(600)
})

it('finds the nearest of unevenly spread values', () => {
  const values = [0, 5, 7, 25]

  expect(nearestTo(values, axis, 300)).toBe(2) // 10 is nearer to 7 than to 25
  expect(nearestTo(values, axis, 430)).toBe(3) // 16.5 is nearer to 25
  expect(nearestTo(values, axis, 219)).toBe(1) // 5.95
  expect(nearestTo(values, axis, 99)).toBeNull()
})

it('names round values that lie within', () => {
  const texts = (low: number, high: number) => roundTicks(low, high, 5).map(({ text }) => text)

  expect(texts(0, 0.5)).toEqual(['0', '0.1', '0.2', '0.3', '0.4', '0.5'])
  expect(texts(-0.07, 0.03)).toEqual(['-0.06', '-0.04', '-0.02', '0', '0.02'])
})

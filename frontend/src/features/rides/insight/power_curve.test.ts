/* Goal: equal ratios of time stand equally far apart, and power stands from zero. */
import { expect, it } from 'vitest'
import { curvePath, placed, TALL, WIDE } from './power_curve'

const best = (duration_s: number, power_w: number) => ({ duration_s, power_w, from_s: 0 })

it('stands by the logarithm of time', () => {
  const points = placed([best(1, 400), best(10, 200), best(100, 100)])

  expect(points.map(([x]) => x)).toEqual([0, WIDE / 2, WIDE])
  expect(points.map(([, y]) => y)).toEqual([0, TALL / 2, (3 * TALL) / 4])
})

it('draws one point and none', () => {
  expect(curvePath(placed([best(5, 100)]))).toBe('M0.0 0.0')
  expect(curvePath(placed([]))).toBe('')
})

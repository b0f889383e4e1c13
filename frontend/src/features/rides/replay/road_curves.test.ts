// Goal: three rides are drawn where they were, gaps open, and compared place by place.
import { expect, test } from 'vitest'
import type { RideCurves } from '$shared/api/types'
import {
  barPath,
  difference,
  endOf,
  linePath,
  nearest,
  positionsOf,
  Scale,
  topOf,
} from './road_curves'

const ride = (t_s: (number | null)[], nm: (number | null)[]) => ({
  t_s,
  speed_kmh: [10, 20, 30],
  motor_torque_nm: nm,
})
const CURVES: RideCurves = {
  distance_km: [0.1, 0.2, 0.3],
  recorded: ride([10, 20, 30], [0.1, 0.2, 0.3]),
  unchanged: ride([10, 20, 31], [0.1, null, 0.3]),
  replayed: ride([12, 24, 40], [0, 0.2, 0.5]),
}

test('a ride lies over the distance, or over its own time', () => {
  expect(positionsOf(CURVES, 'replayed', 'km')).toEqual([0.1, 0.2, 0.3])
  expect(positionsOf(CURVES, 'replayed', 'time')).toEqual([12, 24, 40])
  expect([endOf(CURVES, 'km'), endOf(CURVES, 'time')]).toEqual([0.3, 40])
  expect(topOf(CURVES, 'motor_torque_nm')).toBe(0.5)
})

test('a difference is of one place, and unknown where one of the two is', () => {
  const apart = difference(CURVES, 'motor_torque_nm')
  expect(apart[0]).toBeCloseTo(-0.1)
  expect(apart[1]).toBeNull()
  expect(apart[2]).toBeCloseTo(0.2)
})

test('a line breaks where nothing is known', () => {
  const [x, y] = [new Scale(0, 0.4, 0, 400), new Scale(0, 1, 100, -100)]
  expect(linePath(CURVES.distance_km, CURVES.unchanged.motor_torque_nm, x, y)).toBe(
    'M100.0 90.0M300.0 70.0',
  )
  expect(barPath(CURVES.distance_km, [0.5, -0.5, null], x, y, true)).toBe(
    'M100.0 100.0V50.0H200.0V100.0',
  )
})

test('a press finds the stretch, and ticks are round', () => {
  const x = new Scale(0, 0.37, 40, 370)
  expect(nearest(CURVES.distance_km, x.value(40 + 220))).toBe(1)
  expect(x.ticks(4)).toEqual([0, 0.1, 0.2, 0.30000000000000004])
})

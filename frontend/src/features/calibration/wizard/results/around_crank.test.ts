/* Goal: what is left of a load is shown against what the same mass makes on a level crank, each
   pedal for itself. Loads by hand: at 60 degrees half of the level torque is left. */
import { expect, it } from 'vitest'
import type { Job } from '../job/types'
import { aroundCrank, meansOf } from './around_crank'

const hung = [
  { side: 'right', crank_angle_deg: 0, load_nm: 40, residual_nm: 0.4 },
  { side: 'right', crank_angle_deg: 0, load_nm: 20, residual_nm: 0.4 },
  { side: 'right', crank_angle_deg: 60, load_nm: 20, residual_nm: 0.4 },
  { side: 'left', crank_angle_deg: 0, load_nm: 40, residual_nm: -0.4 },
  { side: null, crank_angle_deg: 0, load_nm: 0, residual_nm: 0.1 },
].map((one, place) => ({ ...one, capture: place + 1 }))
const job = {
  captures: hung.map(({ capture, ...state }) => ({ number: capture, state })),
  worked: { fit: { residuals: hung } },
} as unknown as Job

it('a load on a steep crank counts against what hangs there, a zero not at all', () => {
  const points = aroundCrank(job)

  expect(points.map((one) => one.capture)).toEqual([1, 2, 3, 4])
  expect(points[2]?.left_pct).toBeCloseTo(1.0)
})

it('each pedal has its own mean at each angle', () => {
  const points = aroundCrank(job)

  expect(meansOf(points, 'right').map((one) => [one.angle_deg, one.left_pct])).toEqual([
    [0, 1.5],
    [60, expect.closeTo(1.0)],
  ])
  expect(meansOf(points, 'left')).toHaveLength(1)
})

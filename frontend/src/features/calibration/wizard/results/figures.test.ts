/* Goal: a correction by pieces is a straight line between its knots and level beyond them, and what
   it corrects is the sensor's curve, not the crank's angle. Knots by hand. */
import { expect, it } from 'vitest'
import type { Job } from '../job/types'
import { correctedNm, straightResiduals } from './figures'

const piecewise = {
  reading_nm: [0, 20, 40],
  correction_nm: [0.1, 0.3, -0.1],
  standard_nm: [0.01, 0.01, 0.01],
  significant: true,
}

it.each([
  [-5, -4.9],
  [0, 0.1],
  [10, 10.2],
  [20, 20.3],
  [30, 30.1],
  [60, 59.9],
])('%d Nm is corrected to %d Nm', (reading, corrected) => {
  expect(correctedNm(piecewise, reading)).toBeCloseTo(corrected, 10)
})

it('a load at another crank angle is no residual of the curve', () => {
  const state = (crank_angle_deg: number) => ({ crank_angle_deg, direction: 'unloading' })
  const job = {
    setup: { angles_deg: [0, 40] },
    captures: [0, 40].map((angle, place) => ({ number: place + 1, state: state(angle) })),
    worked: { fit: { residuals: [{ capture: 1 }, { capture: 2 }] } },
  } as unknown as Job

  expect(straightResiduals(job)).toEqual([{ capture: 1, down: true }])
})

/* Goal: the fullest cell is named by its middle. */
import { expect, it } from 'vitest'
import { cellsOf } from './pedalling'

it('names the cell with most time', () => {
  const map = cellsOf({ speed_step_kmh: 2, gain_step: 0.05, seconds: [[0, 1], [0, 4], [2, 0]] })

  expect([map.columns, map.rows, map.cells.length]).toEqual([3, 2, 3])
  expect(map.most.speed_kmh).toBeCloseTo(3)
  expect(map.most.gain).toBeCloseTo(0.075)
  expect(Math.max(...map.cells.map(({ share }) => share))).toBe(1)
})

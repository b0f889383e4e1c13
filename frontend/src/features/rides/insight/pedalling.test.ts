/* Goal: torque stands over its angle from zero on, and the fullest cell is named by its middle. */
import { expect, it } from 'vitest'
import { cellsOf, linePath, topOf } from './pedalling'

it('draws a turn from its first bin to its last', () => {
  expect(linePath([0, 40, 20, -5], topOf([0, 40, 20, -5]))).toBe(
    'M45.0 100.0L135.0 0.0L225.0 50.0L315.0 100.0',
  )
})

it('names the cell with most time', () => {
  const map = cellsOf({ speed_step_kmh: 2, gain_step: 0.05, seconds: [[0, 1], [0, 4], [2, 0]] })

  expect([map.columns, map.rows, map.cells.length]).toEqual([3, 2, 3])
  expect(map.most.speed_kmh).toBeCloseTo(3)
  expect(map.most.gain).toBeCloseTo(0.075)
  expect(Math.max(...map.cells.map(({ share }) => share))).toBe(1)
})

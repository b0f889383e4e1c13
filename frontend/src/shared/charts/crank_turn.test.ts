/* Goal: torque stands over its angle from zero on. */
import { expect, it } from 'vitest'
import { linePath, topOf } from './crank_turn'

it('draws a turn from its first bin to its last', () => {
  expect(linePath([0, 40, 20, -5], topOf([0, 40, 20, -5]))).toBe(
    'M45.0 100.0L135.0 0.0L225.0 50.0L315.0 100.0',
  )
})

/* Goal: zero is taken from a quiet sensor only. Expected figures by hand. */
import { expect, it } from 'vitest'
import { quietOf } from './zero'

it('gives mean and sample deviation of the newest readings', () => {
  expect(quietOf([900, 1, 3, 5], 3)).toEqual({ mean: 3, deviation: 2, rows: 3 })
})

it('waits until there are enough readings', () => {
  expect(quietOf([1, 2], 3)).toBeNull()
  expect(quietOf([1, null, 2], 3)).toBeNull()
  expect(quietOf(undefined, 3)).toBeNull()
})

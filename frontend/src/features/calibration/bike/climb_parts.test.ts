// Goal: the request for a climb is what was chosen, and what is drawn of it adds nothing up.
import { expect, test } from 'vitest'
import type { ClimbResult } from './bike_server'
import { asSlope, barsOf, withPart, type Part } from './climb_parts'

const part = (kind: Part['kind'], ride_id: number, rise_m: number | null = 0): Part => ({
  kind,
  ride_id,
  from_s: 1,
  to_s: 2,
  rise_m,
  heights: false,
})

test('there is one climb, and every coast-down', () => {
  const both = withPart(withPart([], part('coast', 1)), part('climb', 2))

  const again = withPart(withPart(both, part('climb', 3)), part('coast', 4))

  expect(again.map(({ kind, ride_id }) => [kind, ride_id])).toEqual([
    ['climb', 3],
    ['coast', 1],
    ['coast', 4],
  ])
})

test('a height that was not entered comes from the ride', () => {
  expect(asSlope(part('climb', 1, null)).rise_m).toBeNull()
  expect(asSlope(part('climb', 1, NaN)).rise_m).toBeNull()
  expect(asSlope(part('coast', 1, 0)).rise_m).toBe(0)
})

test('legs and motor are separate, and what was not measured is no zero', () => {
  const needed = { gravity_j: 18000, kinetic_j: -360, rolling_j: 900, air_j: 0, drivetrain_j: 540 }
  const balance = { crank_energy_j: 36000, motor_energy_j: null, needed, contributions: {} }

  const bars = barsOf({ balance } as unknown as ClimbResult)

  expect(bars.map(({ key, wh }) => [key, wh])).toEqual([
    ['legs', 10],
    ['motor', null],
    ['gravity', 5],
    ['kinetic', -0.1],
    ['rolling', 0.25],
    ['air', 0],
    ['drivetrain', 0.15],
  ])
  expect(bars[2]?.share).toBe(0.5)
})

/* Goal: the trail is where the bike was in the last ten seconds, and nothing of before. */
import { expect, it } from 'vitest'
import { Trail } from './trail.svelte'

const at = (speed_kmh: number) => ({ speed_kmh, torque_rate: 0.1 })
const speeds = (trail: Trail) => trail.places.map(({ speed_kmh }) => speed_kmh)

it('keeps ten seconds, in their order', () => {
  const trail = new Trail()
  for (let s = 0; s <= 12; s++) trail.note(at(s), 1000 * s)

  expect(speeds(trail)).toEqual([2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12])
})

it('adds nothing while the bike stands, and keeps where it stands', () => {
  const trail = new Trail()
  for (let s = 0; s <= 60; s++) trail.note(at(s === 0 ? 9 : 0), 1000 * s)

  expect(speeds(trail)).toEqual([0])
})

it('forgets all where the place is unknown', () => {
  const trail = new Trail()
  trail.note(at(5), 0)
  trail.note(null, 50)

  expect(trail.places).toEqual([])
})

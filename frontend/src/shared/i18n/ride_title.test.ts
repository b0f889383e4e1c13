import { describe, expect, it } from 'vitest'
import type { Ride } from '../api/types'
import { Locale } from './locale.svelte'
import { rideTitle } from './ride_title'

const ride = (change: Partial<Ride>): Ride =>
  ({ name: '', state: 'done', started_at: '2026-07-01T22:30:00Z', place: null, ...change }) as Ride
const tokyo = { name: 'Tokyo', country: 'JP', zone: 'Asia/Tokyo', is_loop: false }

describe('a ride is called', () => {
  const locale = new Locale()

  it('by the name it was given', () => {
    expect(rideTitle(ride({ name: 'To work', place: tokyo }), locale)).toBe('To work')
  })

  it('by the time of day where it began, and by the place', () => {
    expect(rideTitle(ride({ place: tokyo }), locale)).toBe('Morning ride, Tokyo')
    const dublin = { name: 'Dublin', country: 'IE', zone: 'Europe/Dublin', is_loop: true }
    expect(rideTitle(ride({ place: dublin }), locale)).toBe('Night loop, Dublin')
  })

  it('by the time of day alone without a place or with an unknown zone', () => {
    const nowhere = { name: null, country: null, zone: 'Moon/Crater', is_loop: null }
    expect(rideTitle(ride({ place: nowhere }), locale)).toMatch(/^\w+ ride$/)
  })

  it('in Chinese too', async () => {
    await locale.speak('zh')
    expect(rideTitle(ride({ place: tokyo }), locale)).toBe('早晨骑行，Tokyo')
  })
})

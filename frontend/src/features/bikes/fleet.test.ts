/* Goal: a bike is found by any of its names, and stands for what is worst of it. */
import type { Bike } from '$shared/api/bike_server'
import type { Device } from '$shared/api/types'
import { expect, it } from 'vitest'
import { ageOf, fleetOf, isFound, isOf, type FleetBike } from './fleet'

const NOW_MS = Date.parse('2026-11-28T12:00:00Z')
const unit = (last_seen_at: string) => ({
  key: 'ebl1:name:0042',
  model: 'ebl1',
  serial_number: 'f015f2',
  firmware_version: '0.1.2',
  last_seen_at,
})
const BIKE: Bike = {
  id: 7,
  name: 'City 7',
  model: 'Commuter',
  frame_number: 'WBK 0017',
  battery: null,
  mileage_km: null,
  mileage_at: null,
  lost_at: null,
  created_at: '2026-03-01T08:00:00Z',
  unit: unit('2026-11-28T11:59:59Z'),
  market: null,
  wheel_circumference_m: null,
  owner: { person_id: 3, name: 'Rita Berg', since: '2026-03-02T08:00:00Z', until: null },
  rides: 0,
  distance_km: null,
  last_ride_at: null,
}
const connected = (...faults_active: string[]) =>
  ({ id: 'd', bike_id: 7, state: 'ready', faults_active }) as unknown as Device

function one(change: Partial<Bike> = {}, ...devices: Device[]): FleetBike {
  const [bike] = fleetOf([{ ...BIKE, ...change }], devices)
  if (!bike) throw new Error('no bike')
  return bike
}

it.each([
  ['sound', one({}, connected())],
  ['fault', one({}, connected('torque_sensor'))],
  ['lost', one({ lost_at: '2026-11-01T08:00:00Z' }, connected('torque_sensor'))],
  ['away', one()],
  ['no_unit', one({ unit: null })],
])('stands as %s', (standing, bike) => expect(bike.standing).toBe(standing))

it('counts a unit that does not answer as away', () => {
  const away = { ...connected('torque_sensor'), state: 'lost' } as unknown as Device

  expect(one({}, away).standing).toBe('away')
})

it.each(['city', 'RITA  berg', 'wbk', 'f015', 'commuter rita', ''])('is found by %j', (typed) =>
  expect(isFound(typed, one())).toBe(true),
)

it('is not found by a word of another', () => {
  expect(isFound('city trail', one())).toBe(false)
})

it('was not seen for long only where it has a unit that is not connected', () => {
  const long_ago = { unit: unit('2026-10-01T12:00:00Z') }

  expect(isOf('unseen', one(long_ago), NOW_MS)).toBe(true)
  expect(isOf('unseen', one(long_ago, connected()), NOW_MS)).toBe(false)
  expect(isOf('unseen', one({ unit: null }), NOW_MS)).toBe(false)
  expect(isOf('unseen', one(), NOW_MS)).toBe(false)
})

it('has an age in the largest measure that fits', () => {
  expect([5, 720, 3 * 3600, 19.5 * 86_400].map(ageOf)).toEqual([
    [1, 'minute'],
    [12, 'minute'],
    [3, 'hour'],
    [19, 'day'],
  ])
})

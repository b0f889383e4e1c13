/* Goal: only rides that the law can be run over are offered. */
import type { Ride } from '$shared/api/types'
import { expect, it } from 'vitest'
import { canBeTried, missingChannels } from './triable'

const channel = (name: string, derived = false) => ({ name, unit: '', scale: 1, derived })
const recorded = ['speed_kmh', 'cadence_rpm', 'assist_mode', 'rider_torque_raw']
const ride = (names: string[], changes: Partial<Ride> = {}) =>
  ({
    state: 'done',
    damage: null,
    period_us: 10_000,
    channels: names.map((name) => channel(name)),
    ...changes,
  }) as Ride

it('offers a ride that a unit recorded, as counts or as newton metres', () => {
  expect(canBeTried(ride(recorded))).toBe(true)
  expect(canBeTried(ride([...recorded.slice(0, 3), 'rider_torque_nm']))).toBe(true)
})

it('names what a head unit did not record', () => {
  const imported = ride(['speed_kmh', 'cadence_rpm', 'rider_power_w'])
  imported.channels.push(channel('rider_torque_nm', true)) // made of power: the law is not fed so

  expect(missingChannels(imported)).toEqual(['assist_mode', 'rider_torque_nm'])
  expect(canBeTried(imported)).toBe(false)
})

it.each([
  ['recorded too slowly', { period_us: 1_000_000 }],
  ['irregular', { period_us: null }],
  ['still being recorded', { state: 'live' as const }],
  ['damaged', { damage: 'changed' as const }],
])('offers no ride that is %s', (_, changes) => {
  expect(canBeTried(ride(recorded, changes))).toBe(false)
})

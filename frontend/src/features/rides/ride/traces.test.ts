/* Goal: a ride shows the channels it has, and says what it lacks and what was only demanded of the
   motor. */
import { expect, it } from 'vitest'
import type { Ride } from '$shared/api/types'
import { Locale } from '$shared/i18n/locale.svelte'
import { rowName, rowsFor, rowsOf } from './traces'

it('draws the demanded torque behind the delivered one', () => {
  const { shown } = rowsFor(
    ['motor_torque_crank_nm', 'motor_torque_demanded_crank_nm'],
    'delivered',
  )

  expect(shown.map((row) => row.key)).toEqual(['motor_torque_crank'])
  expect(shown[0]?.lines.map((line) => line.name)).toEqual(['motor_demanded', 'motor_delivered'])
})

it('calls a motor torque demanded where it was not measured', () => {
  const { shown } = rowsFor(['motor_torque_crank_nm'], 'demanded')

  expect(shown.map((row) => row.key)).toEqual(['motor_torque_crank_asked'])
})

it('names what a head unit did not record', () => {
  const { shown, missing } = rowsFor(['speed_kmh', 'rider_power_w', 'heart_rate_bpm'])

  expect(shown.map((row) => row.key)).toEqual(['speed', 'power', 'heart_rate'])
  expect(missing).toEqual(['rider_torque', 'motor_torque_crank', 'gain'])
})

it('has a row for every channel, also for one that only its file knows', () => {
  const names = ['speed_kmh', 'left_right_balance', 'unknown_61']
  const channels = names.map((name) => ({ name, unit: name === 'unknown_61' ? '' : '%' }))

  const { all, usual } = rowsOf({ channels, motor_torque_meaning: null } as unknown as Ride)

  expect(all.map((row) => row.key)).toEqual(['speed', 'left_right_balance', 'unknown_61'])
  expect(all[1]?.unit).toBe('%')
  expect(usual).toEqual(['speed'])
  expect(rowName('unknown_61', new Locale())).toBe('unknown 61')
})

it('shows the channels of a ride that has none of the usual ones', () => {
  const channels = [{ name: 'unknown_61', unit: '' }]

  const { usual } = rowsOf({ channels, motor_torque_meaning: null } as unknown as Ride)

  expect(usual).toEqual(['unknown_61'])
})

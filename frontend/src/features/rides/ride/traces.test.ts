/* Goal: a ride shows the channels it has, and says what it lacks or was only asked of the motor. */
import { expect, it } from 'vitest'
import { rowsFor } from './traces'

it('draws what was asked of the motor behind what it gave', () => {
  const { shown } = rowsFor(
    ['motor_torque_crank_nm', 'motor_torque_demanded_crank_nm'],
    'delivered',
  )

  expect(shown.map((row) => row.key)).toEqual(['motor_torque_crank'])
  expect(shown[0]?.lines.map((line) => line.name)).toEqual(['motor_asked', 'motor_given'])
})

it('calls a motor torque asked where nobody measured it', () => {
  const { shown } = rowsFor(['motor_torque_crank_nm'], 'demanded')

  expect(shown.map((row) => row.key)).toEqual(['motor_torque_crank_asked'])
})

it('names what a head unit did not record', () => {
  const { shown, missing } = rowsFor(['speed_kmh', 'rider_power_w', 'heart_rate_bpm'])

  expect(shown.map((row) => row.key)).toEqual(['speed', 'power', 'heart_rate'])
  expect(missing).toEqual(['rider_torque', 'motor_torque_crank', 'gain'])
})

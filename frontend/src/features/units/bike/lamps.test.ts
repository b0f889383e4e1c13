/* Goal: a lamp says what the unit says, and every fault of the registry has one. */
import { FAULTS } from '$generated/registry'
import type { Device } from '$shared/api/types'
import { expect, it } from 'vitest'
import { lampsOf } from './lamps'

const unit = (...faults_active: string[]) => ({ faults_active }) as unknown as Device
const states = (device: Device, connected = true) =>
  Object.fromEntries(lampsOf(device, connected).map((lamp) => [lamp.name, lamp.state]))

it('shows the part that a fault is about', () => {
  expect(states(unit('torque_stuck', 'battery_low'))).toEqual({
    torque: 'bad',
    speed: 'ok',
    motor: 'ok',
    battery: 'bad',
    link: 'ok',
    firmware: 'ok',
  })
})

it('warns of a zero that has moved by the rides, unless the unit says worse', () => {
  expect(lampsOf(unit(), true, 'ok')[0]?.state).toBe('ok')
  expect(lampsOf(unit(), true, 'watch')[0]?.state).toBe('warn')
  expect(lampsOf(unit(), true, 'act')[0]?.state).toBe('warn')
  expect(lampsOf(unit('torque_drift'), true, 'act')[0]?.state).toBe('bad')
  expect(lampsOf(unit(), false, 'act')[0]?.state).toBe('unknown')
})

it('has a lamp for every fault that the registry knows', () => {
  const without = Object.keys(FAULTS).filter(
    (name) => !lampsOf(unit(name), true).some((lamp) => lamp.fault === name),
  )

  expect(without).toEqual([])
})

it('knows nothing of a unit that is away, not even that it is well', () => {
  expect(new Set(Object.values(states(unit('torque_stuck'), false)))).toEqual(new Set(['unknown']))
})

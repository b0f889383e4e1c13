// @vitest-environment happy-dom
/* Goal: the sheet shows a ride only if it was made after the work, a calibration only as the
   history has it, and of the sensor's zero what the rides show. */
import type { Revision, Ride, SensorDrift } from '$shared/api/types'
import type { Units } from '$shared/units/units.svelte'
import { expect, it } from 'vitest'
import { checksOf, type Reading } from './checks'
import { newJob, type Job } from './job'
import { lastChange, rideAfter } from './on_sheet'
import en from '$messages/en/service.json'

const at = (hour: number) => new Date(Date.UTC(2026, 10, 22, hour)).toISOString()
const ride = (hour: number, state = 'done') => {
  const row: Partial<Ride> = { id: hour, state: state as Ride['state'], started_at: at(hour) }
  return row as Ride
}
const revision = (hour: number, changed: Revision['changed'] = []) => {
  const row: Partial<Revision> = { seq: hour, created_at: at(hour), changed }
  return row as Revision
}
const job = (...over: number[]): Job => ({
  ...newJob(),
  begun_at: at(8),
  faults: over.map((hour) => ({ name: `${hour}`, count: 1, seen_at: at(8), over_at: at(hour) })),
})

it('takes a ride after the newest settings and the newest fault that was over', () => {
  expect(rideAfter(ride(14), job(), [revision(13), revision(9)])?.id).toBe(14)
  expect(rideAfter(ride(12), job(), [revision(13), revision(9)])).toBeNull()
  expect(rideAfter(ride(14), job(15, 10), [revision(13)])).toBeNull()
  // Over when it was first seen: its start is unknown.
  expect(rideAfter(ride(9), { ...job(8), begun_at: at(7) }, [])?.id).toBe(9)
})

it('takes one after the sheet was begun where nothing was done, and none that goes on', () => {
  expect(rideAfter(ride(9), job(), [])?.id).toBe(9)
  expect(rideAfter(ride(7), job(), [])).toBeNull()
  expect(rideAfter(ride(9, 'live'), job(), [])).toBeNull()
  expect(rideAfter(null, job(), [])).toBeNull()
})

it('shows the newest change of a parameter, and none where there was none', () => {
  const name = 'sensor_offset_counts'
  const history = [
    revision(12, [{ name: 'pedal_stop_ms', old: 1, new: 2 }]),
    revision(11, [{ name, old: 0, new: -3 }]),
    revision(10, [{ name, old: 5, new: 0 }]),
  ]

  expect(lastChange(history, name)).toEqual({ old: 0, new: -3, at: at(11) })
  expect(lastChange(history, 'sensor_gain_nm_per_count')).toBeNull()
})

// The check of the zero: what the rides show, and a fail where the assist would stop.
const units = {
  text: (value: number, unit: string, digits = 1) => `${value.toFixed(digits)} ${unit}`,
} as unknown as Units
const say = (key: keyof typeof en, values: Record<string, unknown> = {}) =>
  Object.entries(values).reduce(
    (text, [name, value]) => text.replace(`{${name}}`, String(value)),
    en[key] as string,
  )
const row = (level: SensorDrift['level'], zero_nm: number): SensorDrift =>
  ({
    act_nm: 3,
    level,
    latest: level && { zero_nm, started_at: 'Monday' },
    rides: [{ zero_nm }, { zero_nm: null }, { zero_nm }],
    trend: null,
  }) as unknown as SensorDrift
const NOTHING: Reading = {
  channels: {},
  wear: null,
  counters: {},
  drift: null,
  battery_v_min: null,
  faults_active: [],
}
const checked = (drift: SensorDrift | null) => {
  const reading = { ...NOTHING, drift }
  const all = checksOf(reading, say, units, (iso) => iso)
  return all.find(({ word }) => word === 'check_drift')
}

it('names the newest zero with its ride, and passes while the zero holds', () => {
  expect(checked(row('ok', 0.42))).toMatchObject({
    result: '0.42 Nm, Monday; of 2 rides',
    allowed: '≤ 3 Nm',
    passed: true,
  })
})

it('warns of a zero that has moved, and fails one at which the unit gives no assist', () => {
  expect(checked(row('watch', 1.4))).toMatchObject({ passed: true })
  expect(checked(row('watch', 1.4))?.result).toContain('watch it')
  expect(checked(row('act', -3.2))).toMatchObject({ passed: false })
})

it('shows the trend where the rides have one', () => {
  const trend = { per_month_nm: { value: 0.2 } } as unknown as SensorDrift['trend']

  expect(checked({ ...row('ok', 0.4), trend })?.result).toContain('0.20 Nm a month')
})

it('is not done where no ride shows the zero', () => {
  expect(checked(row(null, 0))).toMatchObject({ result: en.drift_none, passed: null })
  expect(checked(null)).toMatchObject({ passed: null })
})

const zeroCheck = (reading: Partial<Reading>) =>
  checksOf({ ...NOTHING, ...reading }, say, units, (iso) => iso)[0]

it('fails a sensor that the unit calls faulty, with a reading and without', () => {
  const dead = { channels: { rider_torque_nm: null }, faults_active: ['torque_sensor'] }
  const stuck = { channels: { rider_torque_nm: 0 }, faults_active: ['torque_stuck'] }

  expect(zeroCheck(dead)).toMatchObject({ result: en.no_reading, passed: false })
  expect(zeroCheck(stuck)).toMatchObject({ result: '0.0 Nm', passed: false })
  expect(zeroCheck({ channels: {}, faults_active: ['torque_link'] })?.passed).toBe(false)
})

it('distinguishes a value that is missing now from one that the unit never sends', () => {
  expect(zeroCheck({ channels: { rider_torque_nm: null } })).toMatchObject({
    result: en.no_reading,
    passed: null,
  })
  expect(zeroCheck({})).toMatchObject({ result: en.why_unsent, passed: null })
  expect(zeroCheck({ channels: { rider_torque_nm: 0.5 } })).toMatchObject({ passed: true })
})

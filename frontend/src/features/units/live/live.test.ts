/* Goal: what the page works out of the unit's rows is what the rows say: where something limited
   the motor, how torque lies round the crank, and that a frozen value is no measurement.
   Method: rows made by hand, 100 a second; the balance by integrating a known torque. */
import { FLAGS } from '$generated/registry'
import { expect, it } from 'vitest'
import { lastTurns, place } from './crank'
import { measured } from './figures'
import { stretches } from './limited_spans'

const STEP_S = 0.01
const bit = (flag: keyof typeof FLAGS.limit_flags) => 2 ** FLAGS.limit_flags[flag]

type AtTime = (at_s: number) => number

function rows(seconds: number, word: AtTime, fault: AtTime = () => 0) {
  const times = Array.from({ length: seconds / STEP_S }, (_, row) => row * STEP_S)
  const faults = times.map(fault)
  return { times, limits: times.map(word), faults, faults_high: times.map(() => 0) }
}

it('joins what returns within a stroke and leaves out ramps and blinks', () => {
  const input = rows(20, (at_s) => {
    if (at_s > 2 && at_s < 4) return at_s % 0.5 < 0.3 ? bit('battery_current') : 0
    if (at_s > 8 && at_s < 8.05) return bit('market')
    return bit('ramp_up')
  })

  const [span, ...others] = stretches(input)

  expect(others).toEqual([])
  expect(span?.from_s).toBeCloseTo(2.01)
  expect(span?.to_s).toBeCloseTo(3.79)
  expect(span?.limits).toEqual(['battery_current'])
})

it('separates a fault from the limit before it, and shows that it goes on', () => {
  const sensor = 2 ** FLAGS.fault_flags.torque_sensor
  const input = rows(
    6,
    (at_s) => (at_s < 3 ? bit('motor_torque') : bit('fault')),
    (at_s) => (at_s < 3 ? 0 : sensor),
  )

  const [before, fault] = stretches(input)

  expect(before).toMatchObject({ from_s: 0, limits: ['motor_torque'], faults: [] })
  expect(fault).toMatchObject({ to_s: Infinity, limits: [], faults: ['torque_sensor'] })
})

it('splits the work between the feet by the angle the crank turned', () => {
  // 60 turns a minute for 4.3 s; the left foot pushes with 30 Nm, the right one with 20 Nm.
  const angles = Array.from({ length: 430 }, (_, row) => (row * 3.6) % 360)
  const torques = angles.map((angle) => (angle < 180 ? 30 : 20))

  const last = lastTurns(angles, torques)

  expect(last?.left).toBeCloseTo(0.6)
  expect(last?.torque_nm_max).toBe(30)
  expect(last?.turns.map((turn) => turn.length)).toEqual([100, 100, 100, 30])
})

it('draws nothing before the cranks have turned once, nor over a gap', () => {
  const angles = Array.from({ length: 250 }, (_, row) => (row * 3.6) % 360)
  const torques = angles.map(() => 20)

  expect(lastTurns(angles.slice(0, 90), torques.slice(0, 90))).toBeNull()
  expect(lastTurns([...angles.slice(0, 240), null, ...angles.slice(240)], torques)).toBeNull()
})

it('has the left pedal on the left while it goes down', () => {
  expect(place(90, 10)[0]).toBeCloseTo(-10)
  expect(place(0, 10)[1]).toBeCloseTo(-10)
})

it('shows no average of a reading that is missing', () => {
  const shown = measured({ rider_torque_nm: null, rider_torque_filtered_nm: 29.3, speed_kmh: 12 })

  expect(shown).toMatchObject({ rider_torque_filtered_nm: null, speed_kmh: 12 })
})

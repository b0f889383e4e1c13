/* Goal: a replay's figures are true: what is missing is missing, torque that was only demanded is
   called so, and only limits that were at work are named. */
import type { Replay } from '$shared/api/types'
import { expect, it } from 'vitest'
import {
  direction,
  drawnRows,
  drawnSeries,
  figureRows,
  limitRows,
  shownDifference,
  whyNoWork,
} from './answer'

const bins = (name: string, ...max: (number | null)[]) => ({ name, unit: 'Nm', min: max, max })
const both = { recorded: 5, replayed: 6, difference: 1 }

function replay(changes: Partial<Replay> = {}): Replay {
  return {
    ride_id: 1,
    mode: 'open_loop',
    meaning: '',
    config_source: 'ride',
    engine: '',
    inputs_missing: [],
    rows: 2,
    motor_torque_meaning: 'delivered',
    wh_per_km: both,
    distance_km: 1,
    duration_s: 2,
    range_km: null,
    motor_work_wh: both,
    motor_torque_nm_max: both,
    motor_power_w_mean: both,
    ripple_nm_per_s: both,
    motor_torque_nm_difference_max: 1,
    limit_shares: { taper: 0, brake: 0.1, ramp_up: 0.3, fault: 0 },
    limit_shares_recorded: { taper: 0, brake: 0.1, ramp_up: 0, fault: 0.2 },
    series: {
      from_s: 0,
      to_s: 2,
      rows: 2,
      bins: 2,
      kind: 'rows',
      axis: 'time',
      x_first: null,
      x_last: null,
      t_first_s: [0, 1],
      t_last_s: [0, 1],
      channels: [
        bins('motor_torque_nm', 1.5, null),
        bins('replayed_motor_torque_nm', 1.25, 1.75),
        bins('motor_torque_demanded_nm', 2, 2),
        bins('replayed_motor_torque_demanded_nm', 2.5, 2),
        bins('replayed_fuzzy_gain', 0.1, 0.2),
      ],
    },
    ...changes,
  }
}
/** As earlier units recorded it: one motor torque, the demanded one. */
const demandOnly = (changes: Partial<Replay> = {}) => {
  const { series } = replay()
  const channels = series.channels.filter(({ name }) => name !== 'motor_torque_demanded_nm')
  const unknown = { recorded: null, replayed: 6, difference: null }
  return replay({
    motor_torque_meaning: 'demanded',
    wh_per_km: unknown,
    motor_work_wh: unknown,
    series: { ...series, channels },
    ...changes,
  })
}
const channels = (one: Replay) => drawnSeries(one).channels.map(({ name }) => name)
const torque = (one: Replay) => figureRows(one, drawnSeries(one))[2]

it('draws what the motor gave over what it would have given', () => {
  const [row, gain] = drawnRows(replay(), drawnSeries(replay()))

  expect(channels(replay())).toEqual([
    'motor_torque_nm',
    'replayed_motor_torque_nm',
    'replayed_fuzzy_gain',
  ])
  expect(row?.key).toBe('torque_delivered')
  expect(row?.lines.map((line) => line.name)).toEqual(['as_ridden', 'open_loop'])
  // A gain that was not recorded is not named either.
  expect(gain?.lines.map((line) => line.name)).toEqual(['open_loop'])
})

it('compares demanded torque with the replayed demand, and names it so', () => {
  const [row] = drawnRows(demandOnly(), drawnSeries(demandOnly()))

  expect(channels(demandOnly())).toEqual([
    'motor_torque_demanded_nm',
    'replayed_motor_torque_demanded_nm',
    'replayed_fuzzy_gain',
  ])
  expect(row?.key).toBe('torque_demanded')
  expect(torque(demandOnly())).toMatchObject({ key: 'demanded_nm', recorded: 1.5, replayed: 2.5 })
})

it('finds the largest torque in the bins, which keep every extreme', () => {
  expect(torque(replay())).toMatchObject({
    key: 'torque_nm',
    recorded: 1.5,
    replayed: 1.75,
  })
})

it('leaves missing what was not recorded', () => {
  const { series } = replay()
  const none = replay({
    motor_torque_meaning: null,
    series: { ...series, channels: [bins('replayed_motor_torque_nm', 1, 2)] },
  })

  expect(torque(none)).toMatchObject({ recorded: null, replayed: 2 })
  expect(figureRows(replay({ wh_per_km: null }), drawnSeries(replay()))[0]).toMatchObject({
    key: 'wh_per_km',
    recorded: null,
    replayed: null,
  })
})

it('says why the work as ridden is not known', () => {
  const motor_work_wh = { recorded: null, replayed: 6, difference: null }

  expect(whyNoWork(replay())).toBeNull()
  expect(whyNoWork(demandOnly())).toBe('demanded')
  expect(whyNoWork(replay({ motor_work_wh }))).toBe('speed')
  expect(whyNoWork(replay({ motor_work_wh, motor_torque_meaning: null }))).toBe('torque')
})

it('names limits that were at work as ridden or replayed, the longest first', () => {
  expect(limitRows(replay())).toEqual([
    { name: 'ramp_up', recorded: 0, replayed: 0.3 },
    { name: 'brake', recorded: 0.1, replayed: 0.1 },
    { name: 'fault', recorded: 0.2, replayed: 0 },
  ])
  expect(limitRows(replay({ limit_shares_recorded: null })).map((row) => row.recorded)).toEqual([
    null,
    null,
  ])
})

it('shows the difference that a reader finds between the figures as they are shown', () => {
  expect(shownDifference(2.974, 2.995, 2)).toBe(0.03) // 2.97 and 3.00
  expect(shownDifference(2.971, 2.974, 2)).toBe(0)
  expect(shownDifference(null, 2, 2)).toBeNull()
  expect([0.03, -0.01, 0].map(direction)).toEqual(['more', 'less', 'same'])
})

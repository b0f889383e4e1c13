/* Goal: what both rides have comes first, bins keep their edges and gaps, and a moment is read as
   it is written. */
import type { ComparedChannel, ComparedSeries } from '$shared/api/types'
import { expect, it } from 'vitest'
import { apartUnit, binAt, inOrder, rowsOf, secondsOf, seriesOf, usualOf } from './compared'

const channel = (name: string, a = true, b = true): ComparedChannel => ({ name, unit: '', a, b })
const channels = [
  channel('soil_ph'),
  channel('cadence_rpm'),
  channel('motor_torque_crank_nm', true, false),
  channel('motor_torque_demanded_crank_nm'),
  channel('speed_kmh'),
  channel('rider_power_w'),
]

it('names first what both have, in the order of interest', () => {
  expect(inOrder(channels).map(({ name }) => name)).toEqual([
    'speed_kmh',
    'rider_power_w',
    'motor_torque_demanded_crank_nm',
    'cadence_rpm',
    'soil_ph',
    'motor_torque_crank_nm',
  ])
})

it('shows speed, the rider and the demand of both motors, never the delivery of one', () => {
  expect(usualOf(channels)).toEqual([
    'speed_kmh',
    'rider_power_w',
    'motor_torque_demanded_crank_nm',
  ])
  expect(usualOf([channel('soil_ph'), channel('speed_kmh', true, false)])).toEqual(['soil_ph'])
})

it('draws a difference only of what both have', () => {
  const rows = rowsOf([channel('speed_kmh'), channel('grade_pct', false, true)], (name) => name)

  expect(rows.map(({ key, lines }) => [key, lines.map((line) => line.channel)])).toEqual([
    ['speed_kmh', ['a speed_kmh', 'b speed_kmh']],
    ['speed_kmh: B − A', ['apart speed_kmh']],
    ['grade_pct', ['b grade_pct']],
  ])
})

it('has degrees apart without a zero of their own', () => {
  expect([apartUnit('degC'), apartUnit('Nm')]).toEqual(['degC apart', 'Nm'])
})

const comparison: ComparedSeries = {
  by: 'distance',
  unit: 'm',
  end_x: 30,
  x: [0, 10, 20, 30],
  channels: [
    {
      name: 'speed_kmh',
      unit: 'km/h',
      a: { min: [1, null, 3], max: [2, null, 3] },
      b: null,
      difference: null,
    },
  ],
  a_gaps: [],
  b_gaps: [],
}

it('keeps edges, extremes and gaps of the bins', () => {
  const series = seriesOf(comparison)

  expect([...series.t_first_s, ...series.t_last_s]).toEqual([0, 10, 20, 10, 20, 30])
  expect(series.channels.map(({ name }) => name)).toEqual(['a speed_kmh'])
  expect([...(series.channels[0]?.max ?? [])]).toEqual([2, NaN, 3])
})

it.each([
  [-1, -1],
  [0, 0],
  [9.99, 0],
  [10, 1],
  [30, 2],
  [30.1, -1],
])('finds the bin of %d m', (x, bin) => {
  expect(binAt(seriesOf(comparison), x)).toBe(bin)
})

it.each([
  ['0:34', 34],
  ['1:02:03', 3723],
  ['12:30.5', 750.5],
  [' 90 ', 90],
  ['', null],
  ['1:x', null],
  ['1:2:3:4', null],
  ['-5', null],
])('reads %s', (text, seconds) => {
  expect(secondsOf(text)).toBe(seconds)
})

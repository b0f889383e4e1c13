// @vitest-environment happy-dom
/* Goal: a ride is summarised by eight figures, and one that is missing says why. */
import { expect, it } from 'vitest'
import type { Ride } from '$shared/api/types'
import { Locale, fill } from '$shared/i18n/locale.svelte'
import { Units } from '$shared/units/units.svelte'
import { headline } from './headline'
import en from '$messages/en/ride.json'
import type { Say } from './words'

const locale = new Locale()
const say: Say = (key, values) => fill(en[key], values)
const speech = { say, locale, units: new Units(locale, 'metric') }
const ride = (channels: string[], summary: object, meaning: string | null = null) =>
  ({
    channels: channels.map((name) => ({ name })),
    summary: { duration_s: 600, ...summary },
    motor_torque_meaning: meaning,
  }) as unknown as Ride
const figuresOf = (one: Ride) =>
  Object.fromEntries(
    headline(one, null, speech).map(({ name, value, note }) => [name, { value, note }]),
  )

it('gives the ratio of two energies and never their sum', () => {
  const figures = figuresOf(ride([], { rider_wh: 40, motor_wh: 30 }))

  expect(figures['your_energy']?.value).toEqual(['40.0', 'Wh'])
  expect(figures['motor_energy']?.value).toEqual(['30.0', 'Wh'])
  expect(figures['per_yours']?.value).toEqual(['0.75', ''])
})

it('has a reason for each of eight figures of a ride with a heart rate only', () => {
  const figures = headline(ride(['heart_rate_bpm'], {}), null, speech)

  expect(figures).toHaveLength(8)
  expect(figures.every(({ value }) => value === null)).toBe(true)
  expect(figures.every(({ note }) => note !== '' && !note.includes('—'))).toBe(true)
})

it('gives as a reason what is missing, not what is there', () => {
  const note = (channels: string[], name: string) => figuresOf(ride(channels, {}))[name]?.note

  expect(note(['altitude_m'], 'climb')).toBe('height without a distance')
  expect(note([], 'climb')).toBe('no height recorded')
  expect(note(['rider_torque_nm'], 'your_energy')).toBe('torque without a cadence')
  expect(note(['battery_voltage_v'], 'from_battery')).toBe('voltage without a current')
  expect(note(['battery_current_a'], 'from_battery')).toBe('current without a voltage')
})

it('says by what the distance was found', () => {
  const note = (source: string) =>
    figuresOf(ride([], { distance_km: 10, distance_source: source }))['distance']?.note

  expect(note('odometer')).toBe('as its odometer counted')
  expect(note('speed')).toBe('speed over time')
  expect(note('positions')).toBe('along its track')
})

it('distinguishes a motor torque that was only demanded from one that was not recorded', () => {
  const demanded = figuresOf(ride([], {}, 'demanded'))
  expect(demanded['motor_energy']?.note).toBe('only requested, not measured')
  expect(figuresOf(ride([], {}))['motor_energy']?.note).toBe('no motor power recorded')
})

it('spreads what the battery gave over the way', () => {
  const figures = figuresOf(ride([], { battery_wh: 50, distance_km: 10, battery_soc_pct_used: 9 }))

  expect(figures['from_battery']?.note.replaceAll('\u00a0', ' ')).toBe(
    '9 % of its charge, 5.00 Wh/km',
  )
})

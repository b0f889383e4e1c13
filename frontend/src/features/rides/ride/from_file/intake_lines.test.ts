// @vitest-environment happy-dom
import { fill, type Locale } from '$shared/i18n/locale.svelte'
import { expect, test } from 'vitest'
import { intakeLines } from './intake_lines'
import en from '$messages/en/from_file.json'
import type { Say } from './words'

const say: Say = (key, values) => fill(en[key], values)
const locale = {
  number: String,
  lookup: (key: string, name: string) => (key === 'column.distance_m' ? 'Distance' : name),
} as unknown as Locale
const nothing = {
  rows_read: 60,
  rows_kept: 60,
  rows_joined: 0,
  rows_spread: 0,
  rows_moved: 0,
  rows_dropped: {},
  values_dropped: {},
  restarts: {},
  turned: [],
  fields_unread: {},
  taken_as: {},
}

test('a file that is completely in its ride has no lines', () => {
  expect(intakeLines(nothing, say, locale)).toEqual([])
})

test('what is not simply a row is listed with its count and reason', () => {
  const intake = {
    ...nothing,
    rows_kept: 56,
    rows_joined: 1,
    rows_dropped: { no_time: 1, clock_jumped: 2 },
    values_dropped: { distance_m: 1 },
    fields_unread: { left_power_phase: 60 },
  }

  expect(intakeLines(intake, say, locale)).toEqual([
    '1 with another of the same time, which they complete',
    '1 without a time',
    '2 with a clock that jumped away',
    '1 impossible values of Distance are left out',
    'left_power_phase is no single number (60 records)',
  ])
})

test('counts that began anew and signs that were turned are listed', () => {
  const intake = {
    ...nothing,
    restarts: { time: 1, distance_m: 3 },
    turned: ['speed_kmh'],
  }

  expect(intakeLines(intake, say, locale)).toEqual([
    'Its seconds began anew 1 times; the rows go on where they were',
    'Distance began anew 3 times; what was ridden each time is added up',
    'speed kmh stood with the opposite sign and was turned: ' +
      'a controller mounted the other way round',
  ])
})

test('what a column is and how its dates are written is listed as its owner said it', () => {
  const taken_as = { date_order: 'month_first', way: 'distance_m, km', foo: 'left out' }

  expect(intakeLines({ ...nothing, taken_as }, say, locale)).toEqual([
    'Its dates have the month before the day, as its owner said',
    'way is Distance (km), as its owner said',
    'foo is kept under its own name, as its owner said',
  ])
})

test('answers of the owner, and where a date is from, are listed', () => {
  const taken_as = {
    speed: 'm/s',
    time_zone: 'Europe/Dublin',
    start: 'file_name',
    clock: 'UTC+02:00',
  }

  expect(intakeLines({ ...nothing, taken_as }, say, locale)).toEqual([
    'speed is in m/s, as its owner said',
    'Its times are of Europe/Dublin, as its owner said',
    'Date and time are from the file’s name',
    'Its times are of UTC+02:00: so far they are from its start, which is in UTC',
  ])
})

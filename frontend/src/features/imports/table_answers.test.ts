/* Goal: nothing is chosen for a rider but the zone of here, a table is read once every question is
   answered, and a later answer keeps the earlier ones. */
import type { TableQuestion } from '$shared/api/types'
import { describe, expect, it } from 'vitest'
import { answered, asRequest, dateReadings, isComplete, unitChoices } from './table_answers'

type Column = TableQuestion['columns'][number]
const column = (name: string, more: Partial<Column> = {}): Column => ({
  name,
  channel: null,
  unit: null,
  units: [],
  samples: [],
  channels: [],
  unread: 0,
  ...more,
})
const SPEEDS = ['km/h', 'm/s', 'mph']
const POWERS = ['rider_power_w', 'motor_power_w', 'battery_power_w']
const speed = column('speed', { channel: 'speed_kmh', units: SPEEDS })
const power = column('power', { channel: 'rider_power_w', unit: 'W', channels: [...POWERS, ''] })
const question: TableQuestion = {
  header_sha256: 'f'.repeat(64),
  kind: 'a table',
  time_zone: true,
  rows_per_second: false,
  date_order: false,
  columns: [speed, column('cadence', { channel: 'cadence_rpm', unit: 'rpm' })],
  offered_channels: [
    { name: 'speed_kmh', unit: 'km/h', units: SPEEDS },
    { name: 'distance_m', unit: 'm', units: ['m', 'km', 'mi'] },
    ...POWERS.map((name) => ({ name, unit: 'W', units: [] })),
  ],
  answer: null,
  files_read: 0,
}
const before = { time_zone: 'UTC', rows_per_second: 5, date_order: null, units: {}, channels: {} }
const begun = answered(question, 'Europe/Dublin')
const complete = { ...begun, units: { speed: 'm/s' } }
const says = (name: string, channel: string | null) => ({
  ...complete,
  channels: { ...complete.channels, [name]: channel },
})

describe('answers about a table', () => {
  it('begins with the zone of here and nothing else', () => {
    expect(begun).toEqual({
      zone: 'Europe/Dublin',
      rate: null,
      order: null,
      channels: { speed: null, cadence: null },
      units: { speed: '', cadence: '' },
      read_again: false,
    })
  })

  it('begins with the earlier answers, as far as they still apply', () => {
    const stored = { ...before, units: { speed: 'knots' }, date_order: 'day_first' as const }
    const draft = answered({ ...question, answer: stored }, 'Europe/Dublin')
    expect(draft).toMatchObject({ zone: 'UTC', units: { speed: '' }, rate: 5, order: 'day_first' })
  })

  it('is complete with a zone, each unit, and a rate where rows have no time', () => {
    expect(isComplete(question, complete)).toBe(true)
    expect(isComplete(question, { ...complete, zone: ' ' })).toBe(false)
    expect(isComplete(question, { ...complete, units: { speed: '' } })).toBe(false)
    expect(isComplete({ ...question, rows_per_second: true }, complete)).toBe(false)
  })

  it('is complete with an order of the dates, and what each column is that is asked', () => {
    const more = { ...question, date_order: true, columns: [power] }
    const draft = answered(more, 'UTC')
    expect(isComplete(more, { ...draft, order: 'day_first' })).toBe(false)
    expect(isComplete(more, { ...draft, channels: { power: 'battery_power_w' } })).toBe(false)
    expect(isComplete(more, { ...draft, order: 'day_first', channels: { power: '' } })).toBe(true)
  })

  it('asks no unit of what is left out, and the unit of what it is said to be', () => {
    expect(unitChoices(question, speed, says('speed', ''))).toEqual([])
    expect(unitChoices(question, speed, says('speed', 'distance_m'))).toEqual(['m', 'km', 'mi'])
    expect(unitChoices(question, speed, says('speed', 'motor_power_w'))).toEqual([])
    expect(isComplete(question, says('speed', 'distance_m'))).toBe(false)
  })

  it('takes the unit that the table says', () => {
    const trip = column('trip', { unit: 'mi' })
    const table = { ...question, columns: [trip] }
    expect(unitChoices(table, trip, says('trip', 'distance_m'))).toEqual([])
    expect(asRequest(table, says('trip', 'distance_m')).units).toEqual({ trip: 'mi' })
    expect(asRequest(table, says('trip', 'speed_kmh')).units).toEqual({ trip: '' })
    expect(asRequest(table, says('trip', null)).units).toEqual({})
  })

  it('sends what is said, and the earlier answers with it', () => {
    const stored = { ...before, units: { wind: 'm/s' }, channels: { wind: 'speed_kmh' } }
    expect(asRequest({ ...question, answer: stored }, says('cadence', ''))).toEqual({
      time_zone: 'Europe/Dublin',
      rows_per_second: 5,
      date_order: null,
      units: { wind: 'm/s', speed: 'm/s' },
      channels: { wind: 'speed_kmh', cadence: '' },
      read_again: false,
    })
  })
})

describe('a date that can be read in two ways', () => {
  const shown = (...samples: string[]) =>
    dateReadings({ ...question, columns: [column('when', { channel: 'time', samples })] })

  it('is the first of the table whose day and month differ', () => {
    expect(shown('', '5/5/2025 11:59:59 PM', '9/5/2025 5:12:01 PM')).toEqual({
      date: '9/5/2025',
      day_first: '2025-05-09',
      month_first: '2025-09-05',
    })
    expect(shown('03-04-25 7:00').day_first).toBe('2025-04-03')
  })

  it('is an example where the first rows show none', () => {
    expect(shown('08:00:00', '12.5').date).toBe('03/04/2025')
  })
})

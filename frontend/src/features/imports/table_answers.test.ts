/* Goal: a unit is never chosen for a rider, and a table is read once every question is answered. */
import type { TableQuestion } from '$shared/api/types'
import { describe, expect, it } from 'vitest'
import { answered, isComplete } from './table_answers'

const column = (name: string, units: string[]) => ({
  name,
  channel: null,
  unit: null,
  units,
  samples: [],
})
const question: TableQuestion = {
  header_sha256: 'f'.repeat(64),
  kind: 'a table',
  time_zone: true,
  rows_per_second: false,
  columns: [column('speed', ['km/h', 'm/s']), column('cadence', [])],
  answer: null,
}

describe('answers about a table', () => {
  it('begins with the zone of here and no unit', () => {
    expect(answered(question, 'Europe/Dublin')).toEqual({
      zone: 'Europe/Dublin',
      units: { speed: '' },
      rate: null,
    })
  })

  it('begins with the earlier answers, as far as they still apply', () => {
    const stored = { time_zone: 'UTC', units: { speed: 'knots' }, rows_per_second: 5 }
    const draft = answered({ ...question, answer: stored }, 'Europe/Dublin')
    expect(draft).toEqual({ zone: 'UTC', units: { speed: '' }, rate: 5 })
  })

  it('is complete with a zone, each unit, and a rate where rows have no time', () => {
    const draft = { zone: 'UTC', units: { speed: 'm/s' }, rate: null }
    expect(isComplete(question, draft)).toBe(true)
    expect(isComplete(question, { ...draft, zone: ' ' })).toBe(false)
    expect(isComplete(question, { ...draft, units: { speed: '' } })).toBe(false)
    expect(isComplete({ ...question, rows_per_second: true }, draft)).toBe(false)
  })
})

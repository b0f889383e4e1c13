// @vitest-environment happy-dom
/* Goal: what is typed on the sheet of a visit is sent as the server takes it, and outlives the page
   until it is there. */
import { beforeEach, expect, it } from 'vitest'
import { edits, EMPTY, formerSheet, storedEdits, storeEdits, wordsOf } from './sheet_fields'

beforeEach(() => localStorage.clear())

it('sends what differs, and neither a number nor a part that is not finished', () => {
  const fields = structuredClone(EMPTY)
  fields.complaint = 'No help'
  fields.counter_km = NaN
  fields.parts.push({ name: '', number: 'A1', quantity: 1 })
  expect(wordsOf(edits(fields, EMPTY))).toEqual({ complaint: 'No help' })

  fields.counter_km = 1204
  fields.parts[0] = { name: 'Plug', number: '', quantity: 2 }
  expect(wordsOf(edits(fields, EMPTY))).toEqual({
    complaint: 'No help',
    counter_km: 1204,
    parts: [{ name: 'Plug', number: null, quantity: 2 }],
  })
})

it('keeps what the server does not have, of each bike', () => {
  storeEdits('bike-1', { done: 'dried' })
  expect([storedEdits('bike-1'), storedEdits('bike-2')]).toEqual([{ done: 'dried' }, {}])
  storeEdits('bike-1', {})
  expect(localStorage.length).toBe(0)
})

it('takes the sheet that an older Spindle kept of a unit, once', () => {
  const values = { job: '0815', owner: 'owner 14', counter: '1,204', technician: 'T', done: '' }
  localStorage.setItem('spindle.job.one', JSON.stringify({ values, faults: [], begun_at: 'x' }))
  const former = { job: '0815', customer: 'owner 14', technician: 'T', counter_km: 1204 }
  expect(formerSheet('one')).toEqual(former)
  expect(formerSheet('one')).toEqual({})
})

it('takes an even older one, and none that nobody wrote in', () => {
  localStorage.setItem('spindle.job.one', JSON.stringify({ complaint: 'No help' }))
  localStorage.setItem('spindle.job.two', JSON.stringify({ values: { technician: 'T' } }))
  expect([formerSheet('one'), formerSheet('two')]).toEqual([{ complaint: 'No help' }, {}])
})

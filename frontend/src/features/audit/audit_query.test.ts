/* Goal: an address says which events are shown, and days are asked for as whole ones. */
import { expect, it } from 'vitest'
import { EVERYTHING, readQuery, searchOf, soughtBy } from './audit_query'
import { exportPath } from './audit_server'

it('reads back what it wrote', () => {
  const query = { who: 'Zoë', kind: 'bike', bike: 3, from: '2026-07-13', to: '' } as const

  expect(readQuery(searchOf(query))).toEqual(query)
  expect(searchOf(EVERYTHING)).toBe('')
})

it('passes over what is no kind, day or number', () => {
  expect(readQuery('?kind=secret&from=yesterday&to=13.7.&bike=x')).toEqual(EVERYTHING)
})

it('asks for whole days, the last one included, and for nothing that is empty', () => {
  const { from, to } = soughtBy({ ...EVERYTHING, from: '2026-12-31', to: '2026-12-31' })

  expect(Date.parse(to ?? '') - Date.parse(from ?? '')).toBe(86_400_000)
  expect(new Date(from ?? '').getHours()).toBe(0)
  expect(soughtBy({ ...EVERYTHING, who: '  ' })).toEqual({})
})

it('has a file of the same events below the page', () => {
  expect(exportPath({ who: 'a b', bike_id: 3 }, 'jsonl')).toBe(
    'api/v1/audit/export?format=jsonl&who=a+b&bike_id=3',
  )
})

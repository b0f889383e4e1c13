/* Goal: the ride after the work is one that began when nothing was worked on any more. */
import type { VisitContent } from '$shared/api/visit_server'
import { expect, it } from 'vitest'
import { workedAt } from './after_work'

const at = (hour: number) => new Date(Date.UTC(2026, 10, 22, hour)).toISOString()
const fault = (seen: number, over: number | null) => ({
  name: `${seen}`,
  count: 1,
  seen_at: at(seen),
  over_at: over === null ? null : at(over),
})
const content = (found: Partial<VisitContent>) =>
  ({ faults: [], changes: [], calibrations: [], ...found }) as unknown as VisitContent

it('goes by the latest of settings, calibrations and faults that were over', () => {
  const changes = [{ changed_at: at(13) }, { changed_at: at(9) }] as VisitContent['changes']
  const calibrations = [{ closed_at: at(14) }] as VisitContent['calibrations']

  expect(workedAt(content({ changes }), at(8))).toBe(at(13))
  expect(workedAt(content({ changes, calibrations }), at(8))).toBe(at(14))
  expect(workedAt(content({ changes, faults: [fault(9, 15)] }), at(8))).toBe(at(15))
})

it('goes by the beginning where nothing was done', () => {
  expect(workedAt(content({}), at(8))).toBe(at(8))
  // Still there, and over when it was first seen: nobody knows when that was.
  expect(workedAt(content({ faults: [fault(9, null), fault(10, 10)] }), at(8))).toBe(at(8))
})

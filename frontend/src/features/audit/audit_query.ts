// Which events an address is about: a link shows what its sender saw.
import type { ObjectKind, Sought } from './audit_server'

export const KINDS = [
  'bike',
  'unit',
  'configuration',
  'calibration',
  'visit',
  'ride',
  'upload',
  'table',
  'library_item',
  'account',
  'key',
  'store',
] as const satisfies readonly ObjectKind[]

/** As its fields hold it: empty for whatever. from, to: days such as 2026-07-13. */
export interface AuditQuery {
  who: string
  kind: ObjectKind | ''
  bike: number | null
  from: string
  to: string
}

export const EVERYTHING: AuditQuery = { who: '', kind: '', bike: null, from: '', to: '' }
const DAY = /^\d{4}-\d\d-\d\d$/

export function readQuery(search: string): AuditQuery {
  const query = new URLSearchParams(search)
  const day = (name: string) => {
    const text = query.get(name) ?? ''
    return DAY.test(text) ? text : ''
  }
  return {
    who: query.get('who') ?? '',
    kind: KINDS.find((kind) => kind === query.get('kind')) ?? '',
    bike: Number(query.get('bike')) || null,
    from: day('from'),
    to: day('to'),
  }
}

export function searchOf(query: AuditQuery): string {
  const search = new URLSearchParams()
  for (const [name, value] of Object.entries(query)) if (value) search.set(name, String(value))
  return search.size > 0 ? `?${search}` : ''
}

/** As the server asks for it: whole days of the reader's time zone, the last one included. */
export function soughtBy({ who, kind, bike, from, to }: AuditQuery): Sought {
  return {
    ...(who.trim() ? { who: who.trim() } : {}),
    ...(kind ? { object_kind: kind } : {}),
    ...(bike === null ? {} : { bike_id: bike }),
    ...(from ? { from: midnight(from, 0) } : {}),
    ...(to ? { to: midnight(to, 1) } : {}),
  }
}

function midnight(day: string, days_later: number): string {
  const [year = 0, month = 1, date = 1] = day.split('-').map(Number)
  return new Date(year, month - 1, date + days_later).toISOString()
}

// What a workshop types on the sheet of a visit, as the fields have it, and what of it is kept in
// this browser.
import type { VisitContent, VisitWords } from '$shared/api/visit_server'

export const TEXTS = ['job', 'technician', 'customer', 'complaint', 'done', 'notes'] as const
export type TextField = (typeof TEXTS)[number]

export interface PartField {
  name: string
  number: string
  /** NaN while it cannot be read. */
  quantity: number | null
}
export type SheetFields = Record<TextField, string> & {
  counter_km: number | null
  parts: PartField[]
}

const blank = Object.fromEntries(TEXTS.map((field) => [field, ''])) as Record<TextField, string>
export const EMPTY: SheetFields = { ...blank, counter_km: null, parts: [] }

export const COUNTER_KM_MAX = 1e6
export const QUANTITY_MAX = 999

const isWithin = (value: number | null, least: number, most: number) =>
  value !== null && value >= least && value <= most

/** A visit's content as fields. */
export function fieldsOf(content: VisitContent): SheetFields {
  const { counter_km, parts } = content
  const texts = Object.fromEntries(TEXTS.map((field) => [field, content[field]]))
  return {
    ...(texts as Record<TextField, string>),
    counter_km,
    parts: parts.map(({ name, number, quantity }) => ({ name, number: number ?? '', quantity })),
  }
}

/** Fields as the server takes them. A number that cannot be read, and a part without a name, wait
    for more to be typed. */
export function wordsOf(fields: Partial<SheetFields>): VisitWords {
  const { counter_km, parts, ...texts } = fields
  const words: VisitWords = { ...texts }
  if (counter_km !== undefined) {
    const is_read = counter_km === null || isWithin(counter_km, 0, COUNTER_KM_MAX)
    if (is_read) words.counter_km = counter_km
  }
  if (parts !== undefined) {
    words.parts = parts
      .filter(({ name, quantity }) => name.trim() && isWithin(quantity, 1, QUANTITY_MAX))
      .map(({ name, number, quantity }) => ({
        name,
        number: number || null,
        quantity: quantity ?? 1,
      }))
  }
  return words
}

/** Fields that say something else than a visit's, as the server would have them. */
export function edits(fields: SheetFields, base: SheetFields): Partial<SheetFields> {
  const [now, before] = [wordsOf(fields), wordsOf(base)] as Record<string, unknown>[]
  const names = Object.keys(now ?? {}).filter(
    (name) => JSON.stringify(now?.[name]) !== JSON.stringify(before?.[name]),
  ) as (keyof SheetFields)[]
  return Object.fromEntries(names.map((name) => [name, fields[name]]))
}

const keyOf = (place: string) => `spindle.visit.${place}`
const formerKey = (unit: string) => `spindle.job.${unit}`

export function storeEdits(place: string, unsent: Partial<SheetFields>): void {
  try {
    if (Object.keys(unsent).length === 0) localStorage.removeItem(keyOf(place))
    else localStorage.setItem(keyOf(place), JSON.stringify(unsent))
  } catch {
    // Nothing can be stored here: it lasts as long as the page.
  }
}

/** What was typed here and did not reach the server. */
export function storedEdits(place: string): Partial<SheetFields> {
  try {
    return JSON.parse(localStorage.getItem(keyOf(place)) ?? '{}') as Partial<SheetFields>
  } catch {
    return {}
  }
}

export function forgetEdits(place: string): void {
  storeEdits(place, {})
}

/** The sheet that an older Spindle kept of a unit in this browser, taken once. */
export function formerSheet(unit_key: string): Partial<SheetFields> {
  try {
    const stored = JSON.parse(localStorage.getItem(formerKey(unit_key)) ?? '{}') as {
      values?: Record<string, unknown>
    }
    const { owner, counter, ...texts } = stored.values ?? (stored as Record<string, unknown>)
    localStorage.removeItem(formerKey(unit_key))
    const former = { ...texts, customer: owner } as Record<string, unknown>
    const typed = TEXTS.filter((name) => former[name])
    if (!typed.some((name) => name !== 'technician')) return {}
    // As that Spindle wrote it: a comma parts thousands.
    const km = Number(String(counter || '-').replaceAll(',', ''))
    const words = Object.fromEntries(typed.map((name) => [name, String(former[name])]))
    return isWithin(km, 0, COUNTER_KM_MAX) ? { ...words, counter_km: km } : words
  } catch {
    return {}
  }
}

// An event in words: who did what, and from what to what.
import en from '$messages/en/audit.json'
import { parameterLabel, valueText } from '$shared/config/parameter_text'
import type { Locale } from '$shared/i18n/locale.svelte'
import type { Units } from '$shared/units/units.svelte'
import type { AuditEvent } from './audit_server'

type Key = keyof typeof en
export type Say = (key: Key, values?: Record<string, string | number>) => string

/** One thing that differs. */
export interface Difference {
  name: string
  label: string
  before: string
  after: string
}

// The unit that a name carries; of several the last, but for what is per count.
const UNITS: Record<string, string> = {
  nm: 'Nm',
  rpm: 'rpm',
  kmh: 'km/h',
  km: 'km',
  v: 'V',
  a: 'A',
  s: 's',
  ms: 'ms',
  degc: 'degC',
  m: 'm',
  pct: '%',
}
const MOMENTS = /_at$|^since$|^owned_from$/
const UNIT_IN_NAME = /_(nm|rpm|kmh|km|v|a|s|ms|degc|m|pct)(?=_|$)/g

export function unitOf(name: string): string {
  if (name.endsWith('_per_count')) return 'Nm/count'
  return UNITS[[...name.matchAll(UNIT_IN_NAME)].at(-1)?.[1] ?? ''] ?? ''
}

export function whoText(say: Say, event: AuditEvent): string {
  const name = event.actor_name || say('by_nobody')
  if (event.actor_kind === 'server') return say('by_server')
  if (event.actor_kind === 'command') return say('by_command', { name })
  return event.key_name === null ? name : say('by_key', { name, key: event.key_name })
}

export function sentence(say: Say, event: AuditEvent): string {
  const name = event.object_name ?? event.bike_name ?? event.unit_key ?? event.object_id ?? '—'
  return say(event.action, { who: whoText(say, event), name, id: event.object_id ?? '—' })
}

/** What differs by name; none where the deed alone is the event. */
export function differences(
  say: Say,
  locale: Locale,
  units: Units,
  { before, after }: Pick<AuditEvent, 'before' | 'after'>,
): Difference[] {
  const names = [...new Set([...Object.keys(before ?? {}), ...Object.keys(after ?? {})])]
  const text = (name: string, value: unknown) => memberText(say, locale, units, name, value)
  return names.map((name) => ({
    name,
    label: memberLabel(say, locale, name),
    before: text(name, before?.[name]),
    after: text(name, after?.[name]),
  }))
}

function memberLabel(say: Say, locale: Locale, name: string): string {
  const key = `member_${name}`
  return key in en ? say(key as Key) : parameterLabel(locale, name)
}

function memberText(
  say: Say,
  locale: Locale,
  units: Units,
  name: string,
  value: unknown,
): string {
  if (value === null || value === undefined) return '—'
  if (typeof value === 'boolean') return say(value ? 'yes' : 'no')
  if (typeof value === 'string') {
    if (MOMENTS.test(name)) return locale.instant(value)
    return choice(say, name, value)
  }
  if (isWords(value)) return value.map((one) => choice(say, name, one)).join(', ')
  if (typeof value === 'object' && !Array.isArray(value)) return JSON.stringify(value)
  const text = valueText(locale, units, { name, unit: unitOf(name) }, value as number)
  // A number stays beside its unit.
  return typeof value === 'number' ? text.replaceAll(' ', '\u00a0') : text
}

const SPOKEN = ['role', 'changed']

function choice(say: Say, name: string, value: string): string {
  const key = `value_${value}`
  return SPOKEN.includes(name) && key in en ? say(key as Key) : value
}

function isWords(value: unknown): value is string[] {
  return Array.isArray(value) && value.every((one) => typeof one === 'string')
}

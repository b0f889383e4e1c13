// Words for parameters: labels, elements, choices, faults and differences, in the reader's units.
import type { Parameter, ParameterValue } from '../api/types'
import type { Locale } from '../i18n/locale.svelte'
import type { Units } from '../units/units.svelte'
import type { DraftChange, ConfigDraft } from './config_draft.svelte'
import { faultsOf, walk, type Element, type Fault } from './limits'
import { isFactorys, needsToken, ratchetMove } from './ratchet'

const MS_PER_S = 1000

export const LABELS = ['NB', 'NS', 'ZO', 'PS', 'PB'] as const

export interface ElementChange {
  key: string
  label: string
  old: string
  value: string
  range: string
  fault: string | null
  /** For what only a token changes, or changes back: what the reader should know. */
  token: string | null
  /** Whether the unit will ask for the maker's token. */
  locked: boolean
}

/** What a parameter is called; a new one is called by its name in words. */
export function parameterLabel(locale: Locale, name: string): string {
  const plain = name.replace(/_(nm|rpm|kmh|v|a|s|ms|degc|m|pct)(?=_|$)/g, '')
  return locale.lookup(`parameter.${name}`, inWords(plain))
}

function inWords(name: string): string {
  const words = name.replaceAll('_', ' ')
  return words.charAt(0).toUpperCase() + words.slice(1)
}

/** What a group of parameters is called; a new one by its name in words. */
export function groupLabel(locale: Locale, group: string): string {
  return locale.lookup(`group.${group}`, inWords(group))
}

/** What a choice of an enumeration is called. */
export function choiceLabel(locale: Locale, choice: string): string {
  return locale.lookup(`choice.${choice}`, choice)
}

/** A number as it is typed: enough digits to be exact in float32, none too many. */
export function typed(value: number): string {
  return Number.isFinite(value) ? String(Number(value.toPrecision(6))) : ''
}

/** A value where it can be typed: whole in its own unit, to four digits in another. */
export function shownTyped(value: number, unit: string, units: Units): string {
  const shown = units.show(value, unit)
  return typed(shown === value ? shown : Number(shown.toPrecision(4)))
}

/** The bounds of a parameter with its unit, such as "0 … 25 km/h". */
export function rangeText(parameter: Parameter, units: Units): string {
  const { min, max, unit } = parameter
  if (min == null || max == null) return ''
  const shown = `${shownTyped(min, unit, units)} … ${shownTyped(max, unit, units)}`
  return `${shown} ${units.label(unit)}`.trim()
}

/** From where to where a value goes without a token, or that it goes beyond. */
export function bandText(
  locale: Locale,
  units: Units,
  parameter: Parameter,
  said: 'known' | 'left',
): string {
  const { free, unit } = parameter
  const shown = (value: number) => `${shownTyped(value, unit, units)} ${units.label(unit)}`.trim()
  return free ? locale.t(`band.${said}`, { low: shown(free.min), high: shown(free.max) }) : ''
}

/** What a token is needed for, in words; null where none is, and for what is lowered a warning. */
function tokenText(
  locale: Locale,
  units: Units,
  parameter: Parameter,
  old: Element | undefined,
  value: Element,
): string | null {
  const { free } = parameter
  const left = free && typeof value === 'number' && !(value >= free.min && value <= free.max)
  if (left && value !== old) return bandText(locale, units, parameter, 'left')
  if (isFactorys(parameter)) return locale.t('token.factory')
  const move = ratchetMove(parameter.name, old ?? null, value)
  return move && locale.t(`ratchet.${move}`)
}

/** A fault in words. */
export function faultText(locale: Locale, units: Units, fault: Fault, unit: string): string {
  if (!('bound' in fault)) return locale.t(`fault.${fault.code}`)
  const bound = `${shownTyped(fault.bound, unit, units)} ${units.label(unit)}`.trim()
  return locale.t(`fault.${fault.code}`, { bound })
}

/** Which element of a parameter is meant: the mode slot, the set or the rule's place. */
export function elementLabel(
  locale: Locale,
  units: Units,
  draft: ConfigDraft,
  parameter: Parameter,
  path: number[],
): string {
  const label = parameterLabel(locale, parameter.name)
  const [row, column] = path
  if (row === undefined) return label
  if (column === undefined) {
    const set = parameter.name.includes('points') ? String(row + 1) : String(row)
    return `${label} ${set}`
  }
  const speeds = draft.value('fuzzy_speed_points_kmh') as number[]
  const rates = draft.value('fuzzy_torque_rate_points') as number[]
  const speed = `${shownTyped(speeds[row] ?? NaN, 'km/h', units)} ${units.label('km/h')}`
  const rule = parameter.name === 'second_rules' ? 'review.second_rule' : 'review.rule'
  return locale.t(rule, { speed, rate: typed(rates[column] ?? NaN) })
}

/** Every element that differs, with its bounds and what is wrong with it. */
export function elementChanges(
  locale: Locale,
  units: Units,
  draft: ConfigDraft,
  change: DraftChange,
): ElementChange[] {
  const { parameter } = change
  const whole = wholeText(locale, parameter.name, change.value)
  if (whole !== null) {
    return [
      {
        key: parameter.name,
        label: parameterLabel(locale, parameter.name),
        old: wholeText(locale, parameter.name, change.old) ?? '—',
        value: whole,
        range: '',
        fault: null,
        token: null,
        locked: false,
      },
    ]
  }
  const faults = faultsOf(parameter, change.value)
  const found: ElementChange[] = []
  walk(change.value, [], (element, path) => {
    const old = elementAt(change.old, path)
    const fault = faults.find((f) => f.path.join() === path.join())?.fault
    if (old === element && !fault) return
    found.push({
      key: `${parameter.name}/${path.join('/')}`,
      label: elementLabel(locale, units, draft, parameter, path),
      old: elementText(locale, units, parameter, old),
      value: elementText(locale, units, parameter, element),
      range: rangeText(parameter, units),
      fault: fault ? faultText(locale, units, fault, parameter.unit) : null,
      token: tokenText(locale, units, parameter, old, element),
      locked: needsToken(parameter, old ?? null, element),
    })
  })
  return found
}

/** A moment, and the bytes of a certificate, as people read them, a dash for none yet; null for any
    other parameter, whose elements stand for themselves. */
export function wholeText(
  locale: Locale,
  name: string,
  value: ParameterValue | null,
): string | null {
  if (name.endsWith('_utc_s')) {
    const known = typeof value === 'number' && value > 0
    return known ? locale.instant(new Date(value * MS_PER_S).toISOString()) : '—'
  }
  if (name !== 'calibration_certificate') return null
  const bytes = Array.isArray(value) ? (value as number[]) : []
  return bytes.some((byte) => byte !== 0)
    ? bytes.map((byte) => byte.toString(16).padStart(2, '0')).join('')
    : '—'
}

/** A whole value in one line, for lists of what changed. */
export function valueText(
  locale: Locale,
  units: Units,
  parameter: Parameter | undefined,
  value: ParameterValue | null,
): string {
  if (value === null) return '—'
  const whole = parameter && wholeText(locale, parameter.name, value)
  if (whole) return whole
  const parts: string[] = []
  walk(value, [], (element) => parts.push(elementText(locale, units, parameter, element)))
  return parts.join(' ')
}

function elementText(
  locale: Locale,
  units: Units,
  parameter: Parameter | undefined,
  element: Element | undefined,
): string {
  if (element === undefined || element === null) return '—'
  if (typeof element === 'string') return choiceLabel(locale, element)
  const unit = parameter?.unit ?? ''
  if (!Number.isFinite(element)) return '—'
  return `${shownTyped(element, unit, units)} ${units.label(unit)}`.trim()
}

function elementAt(value: ParameterValue, path: number[]): Element | undefined {
  let at: unknown = value
  for (const index of path) at = (at as unknown[])[index]
  return at as Element | undefined
}

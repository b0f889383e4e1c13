// Words for parameters: labels, choices, values and faults, in the reader's units.
import type { Parameter, ParameterValue } from '../api/types'
import type { Locale } from '../i18n/locale.svelte'
import { shownTyped } from '../units/typed'
import type { Units } from '../units/units.svelte'
import { walk, type Element, type Fault } from './limits'

const MS_PER_S = 1000

export const LABELS = ['NB', 'NS', 'ZO', 'PS', 'PB'] as const

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
  phrase: 'range' | 'left',
): string {
  const { free, unit } = parameter
  const shown = (value: number) => `${shownTyped(value, unit, units)} ${units.label(unit)}`.trim()
  return free ? locale.t(`band.${phrase}`, { low: shown(free.min), high: shown(free.max) }) : ''
}

/** A fault in words. */
export function faultText(locale: Locale, units: Units, fault: Fault, unit: string): string {
  if (!('bound' in fault)) return locale.t(`fault.${fault.code}`)
  const bound = `${shownTyped(fault.bound, unit, units)} ${units.label(unit)}`.trim()
  return locale.t(`fault.${fault.code}`, { bound })
}

/** A moment, and the bytes of a certificate, as people read them, a dash for none yet; null for any
    other parameter, whose elements stand for themselves. */
export function singleText(
  locale: Locale,
  name: string,
  value: ParameterValue | null,
): string | null {
  if (name.endsWith('_utc_s')) {
    const is_set = typeof value === 'number' && value > 0
    return is_set ? locale.instant(new Date(value * MS_PER_S).toISOString()) : '—'
  }
  if (name !== 'calibration_certificate') return null
  const bytes = Array.isArray(value) ? (value as number[]) : []
  return bytes.some((byte) => byte !== 0)
    ? bytes.map((byte) => byte.toString(16).padStart(2, '0')).join('')
    : '—'
}

type Named = Pick<Parameter, 'name' | 'unit'>

/** A complete value in one line, for lists of what changed. */
export function valueText(
  locale: Locale,
  units: Units,
  parameter: Named | undefined,
  value: ParameterValue | null,
): string {
  if (value === null) return '—'
  const single = parameter && singleText(locale, parameter.name, value)
  if (single) return single
  const parts: string[] = []
  walk(value, [], (element) => parts.push(elementText(locale, units, parameter, element)))
  return parts.join(' ')
}

/** One element in the reader's unit; a dash for none. */
export function elementText(
  locale: Locale,
  units: Units,
  parameter: Named | undefined,
  element: Element | undefined,
): string {
  if (element === undefined || element === null) return '—'
  if (typeof element === 'string') return choiceLabel(locale, element)
  const unit = parameter?.unit ?? ''
  if (!Number.isFinite(element)) return '—'
  return `${shownTyped(element, unit, units)} ${units.label(unit)}`.trim()
}

// What the server says of a calibration with a code, in the reader's language and units.
import { faultList } from '$shared/device/fault_text'
import type { Locale } from '$shared/i18n/locale.svelte'
import type { Units } from '$shared/units/units.svelte'
import type { Cause, Check, Reason } from '../job/types'
import { findings, isFinding, words } from './words'

const DIGITS = 2

/** What a code's figure and what is allowed are in, where that is shown by the reader's units. */
const FIGURE_IN: Readonly<Record<string, string>> = {
  pedals_free: 'Nm',
  temperature: 'degC apart',
  temperature_moving: 'degC apart',
}
/** The same of named values, by how their names end. */
const VALUE_IN: Readonly<Record<string, string>> = { kmh: 'km/h', rpm: 'rpm' }

interface Finding {
  code: string
  sentence: string
  figure?: number | null
  values?: Record<string, number | string>
  allowed?: number | null
}

/** The sentence of a check, a refusal or a cause. */
export function sentenceOf(locale: Locale, units: Units, finding: Reason | Check | Cause): string {
  const { code, sentence, figure, allowed, values } = finding as Finding
  // A code that a newer server has is no word of ours.
  if (!isFinding(code)) return sentence
  const text = (name: string, value: number | string | null | undefined) => {
    if (name === 'names') return faultsText(locale, String(value))
    if (typeof value !== 'number') return value ?? '—'
    const unit = FIGURE_IN[code] ?? VALUE_IN[name.split('_').at(-1) ?? '']
    return unit ? units.text(value, unit) : rounded(locale, value)
  }
  const shown = Object.entries({ allowed, ...values, figure }).map(([name, value]) => [
    name,
    text(name, value),
  ])
  const filled = findings(locale)(code, {
    ...(Object.fromEntries(shown) as Record<string, string>),
    sentence,
  })
  return filled.replace(/\{\w+\}/g, '—')
}

function faultsText(locale: Locale, names: string): string {
  return names ? faultList(locale, names.split(', ')) : words(locale)('none')
}

/** As many decimals as it has, two at most. */
function rounded(locale: Locale, value: number): string {
  const digits = [0, 1].find((n) => Math.abs(value - Number(value.toFixed(n))) < 1e-9) ?? DIGITS
  return locale.number(value, digits)
}

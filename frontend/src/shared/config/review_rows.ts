// What a draft changes, element by element, as the review shows it.
import type { Parameter, ParameterValue } from '../api/types'
import type { Locale } from '../i18n/locale.svelte'
import type { Units } from '../units/units.svelte'
import type { DraftChange, ConfigDraft } from './config_draft.svelte'
import { faultsOf, walk, type Element } from './limits'
import {
  bandText,
  elementText,
  faultText,
  parameterLabel,
  rangeText,
  shownTyped,
  typed,
  wholeText,
} from './parameter_text'
import { isFactorys, needsToken, ratchetMove } from './ratchet'

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

/** Which element of a parameter is meant: the mode slot, the set or the rule's place. */
function elementLabel(
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

function elementAt(value: ParameterValue, path: number[]): Element | undefined {
  let at: unknown = value
  for (const index of path) at = (at as unknown[])[index]
  return at as Element | undefined
}

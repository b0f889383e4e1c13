// What a draft changes, element by element, as the review shows it.
import type { Parameter } from '../api/types'
import type { Locale } from '../i18n/locale.svelte'
import type { Units } from '../units/units.svelte'
import type { DraftChange, ConfigDraft } from './config_draft.svelte'
import { elementAt } from './elements'
import { faultsOf, walk, type Element } from './limits'
import {
  bandText,
  elementText,
  faultText,
  parameterLabel,
  rangeText,
  singleText,
} from './parameter_text'
import { shownTyped, typed } from '../units/typed'
import { isFactorys, needsToken, ratchetMove } from './ratchet'
import type { Say } from './words'

export interface ElementChange {
  key: string
  path: number[]
  label: string
  old: string
  value: string
  /** What the unit had when the edit began, where this element was changed elsewhere meanwhile. */
  before: string | null
  range: string
  fault: string | null
  /** For what only a token changes, or changes back: what the reader should know. */
  token: string | null
  /** Whether the unit will require the maker's token. */
  locked: boolean
}

/** Every element that differs, with its bounds and what is wrong with it. */
export function elementChanges(
  locale: Locale,
  units: Units,
  say: Say,
  draft: ConfigDraft,
  change: DraftChange,
): ElementChange[] {
  const { parameter } = change
  const single = singleText(locale, parameter.name, change.value)
  if (single !== null) {
    return [
      {
        key: parameter.name,
        path: [],
        label: parameterLabel(locale, parameter.name),
        old: singleText(locale, parameter.name, change.old) ?? '—',
        value: single,
        before: null,
        range: '',
        fault: null,
        token: null,
        locked: false,
      },
    ]
  }
  const faults = faultsOf(parameter, change.value)
  const changes: ElementChange[] = []
  walk(change.value, [], (element, path) => {
    const [old, before] = [change.old, draft.before(parameter.name)].map((value) =>
      elementAt(value, path),
    )
    const fault = faults.find((f) => f.path.join() === path.join())?.fault
    if (old === element && !fault) return
    changes.push({
      key: `${parameter.name}/${path.join('/')}`,
      path,
      label: elementLabel(locale, units, say, draft, parameter, path),
      old: elementText(locale, units, parameter, old),
      value: elementText(locale, units, parameter, element),
      before: before === old ? null : elementText(locale, units, parameter, before),
      range: rangeText(parameter, units),
      fault: fault ? faultText(locale, units, fault, parameter.unit) : null,
      token: tokenText(locale, units, parameter, old, element),
      locked: needsToken(parameter, old ?? null, element),
    })
  })
  return changes
}

/** What others changed meanwhile, apart from the edits, as "what: from → to"; it stays. */
export function concurrentChanges(
  locale: Locale,
  units: Units,
  say: Say,
  draft: ConfigDraft,
): string[] {
  return draft.parameters.flatMap((parameter) => {
    const { name } = parameter
    const [was, now, edit] = [draft.before(name), draft.base(name), draft.value(name)]
    const changes: string[] = []
    if (was === undefined || now === undefined) return changes
    if (singleText(locale, name, now) !== null) return changes
    walk(now, [], (element, path) => {
      const old = elementAt(was, path)
      if (old === element || elementAt(edit, path) !== element) return
      const label = elementLabel(locale, units, say, draft, parameter, path)
      const [from, to] = [old, element].map((one) => elementText(locale, units, parameter, one))
      changes.push(`${label}: ${from} → ${to}`)
    })
    return changes
  })
}

/** Which element of a parameter is meant: the mode slot, the set or the rule's place. */
function elementLabel(
  locale: Locale,
  units: Units,
  say: Say,
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
  const rule = parameter.name === 'second_rules' ? 'second_rule' : 'rule'
  return say(rule, { speed, rate: typed(rates[column] ?? NaN) })
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

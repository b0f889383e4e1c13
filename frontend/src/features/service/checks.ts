// The checks of a unit in words: found, allowed.
import type { UnitCheck } from '$shared/api/workbench_server'
import type { Units } from '$shared/units/units.svelte'
import type { Key, Say } from './words'

export interface CheckText {
  word: Key
  result: string
  allowed: string
  passed: boolean | null
}

const WORDS: Record<UnitCheck['name'], Key> = {
  zero: 'check_zero',
  drift: 'check_drift',
  rotor: 'check_rotor',
  battery: 'check_battery',
  motor: 'check_motor',
  controller: 'check_controller',
  flash: 'check_flash',
  line: 'check_line',
}
const NOT_DONE: Record<NonNullable<UnitCheck['not_done']>, Key> = {
  no_reading: 'no_reading',
  not_sent: 'why_unsent',
  moving: 'why_moving',
  no_ride_shows_it: 'drift_none',
  not_known: 'why_unsent',
}

/** The rows of the sheet before anything was looked at. result: why. */
export function undone(result: string): CheckText[] {
  return Object.values(WORDS).map((word) => ({ word, result, allowed: '—', passed: null }))
}

/** One check as a row of the sheet. */
export function checkText(
  check: UnitCheck,
  say: Say,
  units: Units,
  instant: (iso: string) => string,
): CheckText {
  const { name, passed } = check
  return {
    word: WORDS[name],
    result: found(check, say, units, instant),
    allowed: allowed(check, say, units),
    passed,
  }
}

function allowed({ name, limit, unit }: UnitCheck, say: Say, units: Units): string {
  if (name === 'flash') return say('flash_intact')
  if (name === 'line') return say('none_lost')
  if (limit === null || unit === null) return '—'
  if (name === 'battery') return say('at_least', { least: units.text(limit, unit) })
  return say('up_to', { most: units.text(limit, unit, 0) })
}

function found(
  check: UnitCheck,
  say: Say,
  units: Units,
  instant: (iso: string) => string,
): string {
  const { name, value, unit, not_done, fault } = check
  const seen = check.evidence as Record<string, unknown> | null
  if (value !== null && unit !== null) {
    if (name === 'drift') return driftText(value, seen ?? {}, say, units, instant)
    if (not_done !== 'moving') return units.text(value, unit)
  }
  if (fault !== null) return say('no_reading')
  if (not_done !== null) return say(NOT_DONE[not_done])
  if (name === 'line') {
    return say('lost_of', { lost: Number(seen?.lost), built: Number(seen?.built) })
  }
  const places = say(
    seen?.runs_on_default ? 'flash_default' : seen?.damaged ? 'flash_damaged' : 'flash_intact',
  )
  return say('flash_worn', { places, erases: Number(seen?.erases) })
}

/** What the rides show of the zero, with the trend where there is one. */
function driftText(
  zero_nm: number,
  seen: Record<string, unknown>,
  say: Say,
  units: Units,
  instant: (iso: string) => string,
): string {
  const [zero, date] = [units.text(zero_nm, 'Nm', 2), instant(String(seen.started_at))]
  let result = say('drift_result', { zero, date, count: Number(seen.rides) })
  if (typeof seen.per_month_nm === 'number') {
    result = say('drift_rate', { result, rate: units.text(seen.per_month_nm, 'Nm', 2) })
  }
  return seen.level === 'watch' ? say('drift_watch', { result }) : result
}

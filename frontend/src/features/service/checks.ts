// What can be checked of a unit without touching it: found, allowed, and whether it passed.
import type { SensorDrift, WearCounters } from '$shared/api/types'
import { faultOf, type Part } from '$shared/device/fault_parts'
import { healthOf } from '$shared/device/link_health'
import { standstillOf } from '$shared/device/standstill'
import type { Units } from '$shared/units/units.svelte'
import type { Say, Key } from './words'

export interface Reading {
  channels: Readonly<Record<string, number | null>>
  wear: WearCounters | null
  counters: Record<string, number | null>
  /** Of the unit's rides; null where unknown. */
  drift: SensorDrift | null
  /** Of battery_voltage_v_min; null where it is not known. */
  battery_v_min: number | null
  faults_active: readonly string[]
}

export interface Check {
  word: Key
  result: string
  allowed: string
  /** Null: not done, `found` says why. */
  passed: boolean | null
}

// From here on the unit itself counts a fault or lowers the assist.
const ZERO_NM_MAX = 3
const ROTOR_MS_MAX = 250
const MOTOR_DEGC_MAX = 110
const CONTROLLER_DEGC_MAX = 85

/** Every check, in the order of the sheet. */
export function checksOf(
  reading: Reading,
  say: Say,
  units: Units,
  instant: (iso: string) => string,
): Check[] {
  const { channels, wear, counters, battery_v_min, faults_active } = reading
  const at = (name: string) => channels[name] ?? null
  // A channel that the unit sends and has no value of now is missing; any other is not sent.
  const none = (name: string) => say(name in channels ? 'no_reading' : 'why_unsent')

  const bounded = (word: Key, name: string, unit: string, most: number): Check => {
    const value = at(name)
    const allowed = say('up_to', { most: units.text(most, unit, 0) })
    if (value === null) return { word, result: none(name), allowed, passed: null }
    return { word, result: units.text(value, unit), allowed, passed: Math.abs(value) <= most }
  }
  /** What the unit itself calls faulty has failed, whatever its reading. */
  const judged = (check: Check, name: string, ...parts: Part[]): Check => {
    if (!parts.some((part) => faultOf(part, faults_active))) return check
    return { ...check, result: at(name) === null ? say('no_reading') : check.result, passed: false }
  }

  const zero = bounded('check_zero', 'rider_torque_nm', 'Nm', ZERO_NM_MAX)
  const moves = standstillOf(channels).stands === false
  const resting = moves ? { ...zero, result: say('why_moving'), passed: null } : zero
  const volts = at('battery_voltage_v')
  const battery: Check = {
    word: 'check_battery',
    result: volts === null ? none('battery_voltage_v') : units.text(volts, 'V'),
    allowed:
      battery_v_min === null ? '—' : say('at_least', { least: units.text(battery_v_min, 'V') }),
    passed: volts === null || battery_v_min === null ? null : volts >= battery_v_min,
  }
  return [
    judged(resting, 'rider_torque_nm', 'torque', 'link'),
    drifted(reading.drift, say, units, instant),
    judged(bounded('check_rotor', 'torque_age_ms', 'ms', ROTOR_MS_MAX), 'torque_age_ms', 'link'),
    judged(battery, 'battery_voltage_v', 'battery'),
    bounded('check_motor', 'motor_temperature_degc', 'degC', MOTOR_DEGC_MAX),
    bounded('check_controller', 'controller_temperature_degc', 'degC', CONTROLLER_DEGC_MAX),
    flash(wear, say),
    line(counters, say),
  ]
}

/** What the rides show of the zero, with the trend where there is one. */
function drifted(
  drift: SensorDrift | null,
  say: Say,
  units: Units,
  instant: (iso: string) => string,
): Check {
  const word = 'check_drift'
  if (drift === null) return { word, result: say('why_unsent'), allowed: '—', passed: null }
  const allowed = say('up_to', { most: units.text(drift.act_nm, 'Nm', 0) })
  const { latest, level, trend } = drift
  if (latest === null || level === null) {
    return { word, result: say('drift_none'), allowed, passed: null }
  }
  const zero = units.text(latest.zero_nm, 'Nm', 2)
  const count = drift.rides.filter(({ zero_nm }) => zero_nm !== null).length
  let result = say('drift_result', { zero, date: instant(latest.started_at), count })
  if (trend) {
    result = say('drift_rate', { result, rate: units.text(trend.per_month_nm.value, 'Nm', 2) })
  }
  if (level === 'watch') result = say('drift_watch', { result })
  return { word, result, allowed, passed: level !== 'act' }
}

function flash(wear: WearCounters | null, say: Say): Check {
  const word = 'check_flash'
  const allowed = say('flash_intact')
  if (wear === null) return { word, result: say('why_unsent'), allowed, passed: null }
  const bad = wear.config_slots.some(({ state }) => state === 'damaged')
  const places = say(
    wear.runs_on_default ? 'flash_default' : bad ? 'flash_damaged' : 'flash_intact',
  )
  const erases = wear.config_slots.reduce((sum, slot) => sum + slot.erases, 0)
  const passed = !bad && !wear.runs_on_default
  return { word, result: say('flash_worn', { places, erases }), allowed, passed }
}

function line(counters: Reading['counters'], say: Say): Check {
  const health = healthOf(counters)
  const word = 'check_line'
  const allowed = say('none_lost')
  if (!health) return { word, result: say('why_unsent'), allowed, passed: null }
  const lost = health.lost + health.dropped
  const result = say('lost_of', { lost, built: health.built })
  return { word, result, allowed, passed: lost === 0 }
}

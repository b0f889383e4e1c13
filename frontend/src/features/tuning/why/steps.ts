// A control step as rows of a waterfall: what the law demanded, what each clamp took, what is left.
import type { Why } from '$shared/api/types'
import type { Units } from '$shared/units/units.svelte'
import type { Say, Key } from './words'

export type Kind = 'rider' | 'law' | 'demanded' | 'clamp' | 'delivered'

export interface Row {
  name: string
  kind: Kind
  /** The bar, at the crank. */
  from_nm: number
  to_nm: number
  torque_nm: number
  power_w: number | null
}

const LAW = ['rider_torque', 'mode_ratio', 'gain', 'taper', 'mode_off', 'walk_assist']
/** Less than this is not worth a word. */
const TELLING_NM = 0.05

/** The steps in the unit's own order, with the law's demand before the clamps and what is left
    after them. */
export function waterfall(why: Why): Row[] {
  const rows: Row[] = []
  const power = (torque_nm: number) =>
    why.crank_rad_per_s === null ? null : torque_nm * why.crank_rad_per_s
  const addTotal = (name: string, kind: Kind, torque_nm: number) =>
    rows.push({ name, kind, from_nm: 0, to_nm: torque_nm, torque_nm, power_w: power(torque_nm) })
  let at_nm = 0
  for (const [i, { name, torque_nm, power_w }] of why.steps.entries()) {
    const kind = i === 0 ? 'rider' : LAW.includes(name) ? 'law' : 'clamp'
    const to_nm = at_nm + torque_nm
    rows.push({ name, kind, from_nm: at_nm, to_nm, torque_nm, power_w })
    at_nm = to_nm
    const next = why.steps[i + 1]
    if (kind !== 'clamp' && next && !LAW.includes(next.name)) {
      addTotal('demanded', 'demanded', at_nm)
    }
  }
  const delivered = why.delivered_nm
  if (delivered === null) addTotal('commanded', 'delivered', why.commanded_nm)
  else addTotal('delivered', 'delivered', delivered)
  return rows
}

/** The law's demand, before any limit. */
export function demandedNm(why: Why): number {
  return waterfall(why).find((row) => row.kind === 'demanded')?.to_nm ?? 0
}

/** The clamps that took torque, the hardest first. What the motor's own control misses is none. */
export function takers(why: Why): Row[] {
  return waterfall(why)
    .filter(({ kind, name }) => kind === 'clamp' && name !== 'current_control')
    .filter(({ torque_nm }) => torque_nm < -TELLING_NM)
    .sort((one, other) => one.torque_nm - other.torque_nm)
}

const TABLE_BLIND = ['motor_torque', 'battery_current', 'temperature', 'back_emf', 'market']

/** Whether the limits leave nothing for a stronger table to add. */
export function tableCannotHelp(why: Why): boolean {
  const [hardest] = takers(why)
  return hardest !== undefined && TABLE_BLIND.includes(hardest.name)
}

/** The sentence that answers: how much was demanded, how much was delivered, and what took the
    rest. */
export function sentence(why: Why, say: Say, units: Units): string {
  if (why.result !== 'ok') return say(why.result === 'input_refused' ? 'refused' : 'lost')
  const mode = why.law === 'walk' ? say('walk') : named(why.mode_name)
  if (why.law === 'off') return say('off', { mode })
  const demanded_nm = demandedNm(why)
  if (demanded_nm < TELLING_NM) return say('demanded_nothing', { mode })
  const delivered_nm = why.delivered_nm ?? why.commanded_nm
  const demanded = units.text(demanded_nm, 'Nm', 0)
  const delivered = units.text(delivered_nm, 'Nm', 0)
  const taken = takers(why)
  if (taken.length === 0) {
    const uncut = why.delivered_nm === null ? 'uncut_commanded' : 'uncut'
    return say(delivered === demanded ? uncut : 'uncut_short', { mode, demanded, delivered })
  }
  const main = say(why.delivered_nm === null ? 'demanded_commanded' : 'demanded_delivered', {
    mode,
    demanded,
    delivered,
  })
  return `${main} ${whoTook(taken, say, units)}`
}

function whoTook([first, second]: Row[], say: Say, units: Units): string {
  if (!first) return ''
  const by = (row: Row) => say(`by.${row.name}` as Key)
  const watts = amount(first, units)
  if (!second) return say('took_one', { first: by(first), watts })
  const other = by(second)
  // Within a sentence of a language that has capitals.
  const lower = other.charAt(0).toLowerCase() + other.slice(1)
  return say('took_two', { first: by(first), watts, second: lower, more: amount(second, units) })
}

/** What a row took or gave, in watts where the crank turns. */
export function amount(row: Row, units: Units): string {
  const still = !row.power_w && row.torque_nm !== 0
  const [value, unit] = still ? [row.torque_nm, 'Nm'] : [row.power_w ?? 0, 'W']
  return units.text(Math.abs(value), unit)
}

/** A mode's name as a sentence begins. */
export function named(mode: string): string {
  return mode.charAt(0).toUpperCase() + mode.slice(1)
}

/** What a row is called, with its limit. */
export function rowName(row: Row, why: Why, say: Say, units: Units): string {
  const { settings } = why
  const limits: Record<string, string> = {
    pedal_threshold: units.text(settings.pedal_torque_nm_min, 'Nm'),
    speed_cutoff: units.text(settings.cutoff_kmh, 'km/h'),
    battery_voltage: units.text(settings.battery_voltage_v_min, 'V'),
    motor_torque: units.text(settings.motor_torque_nm_max, 'Nm'),
    battery_current: units.text(settings.battery_current_a_max, 'A', 0),
    back_emf: units.text(settings.motor_speed_rpm_max, 'rpm'),
  }
  return say(`step.${row.name}` as Key, {
    ratio: units.number(settings.mode_ratio, '', 2),
    gain: units.number(why.gain, '', 3),
    limit: limits[row.name] ?? '',
  })
}

/** What was read where a row decides; empty where there is nothing to show. */
export function rowDetail(row: Row, why: Why, units: Units): string {
  const { readings, settings } = why
  const shown = (name: string, unit: string) =>
    readings[name] == null ? '' : units.text(readings[name], unit)
  const gear = units.number(settings.gear_ratio, '', 2)
  const most = units.text(settings.motor_torque_nm_max * settings.gear_ratio, 'Nm')
  const details: Record<string, string> = {
    demanded: row.power_w === null ? '' : units.text(row.power_w, 'W'),
    delivered: row.power_w === null ? '' : units.text(row.power_w, 'W'),
    commanded: row.power_w === null ? '' : units.text(row.power_w, 'W'),
    cutoff_band: units.text(why.speed_kmh, 'km/h'),
    ramps: `${units.number(settings.ramp_up_nm_per_s, 'Nm/s', 0)} ${units.label('Nm/s')}`,
    motor_torque: `× ${gear} = ${most}`,
    temperature: shown('motor_temperature_degc', 'degC'),
    battery_voltage: shown('battery_voltage_v', 'V'),
    battery_current: [shown('battery_current_a', 'A'), shown('battery_voltage_v', 'V')]
      .filter(Boolean)
      .join(', '),
    back_emf: shown('motor_speed_rpm', 'rpm'),
  }
  return details[row.name] ?? ''
}

/** What stands at the right of a row: torque in the law, watts at the clamps. */
export function rowValue(row: Row, units: Units): string {
  if (row.kind === 'demanded' || row.kind === 'delivered' || row.kind === 'rider') {
    return units.text(row.torque_nm, 'Nm')
  }
  const sign = row.torque_nm < 0 ? '−' : '+'
  const size =
    row.kind === 'law' ? units.text(Math.abs(row.torque_nm), 'Nm') : amount(row, units)
  // What rounds to nothing has no sign.
  return /[1-9]/.test(size) ? sign + size : size
}

/** All of it as lines of text, for passing on. */
export function asText(why: Why, say: Say, units: Units, head: string): string {
  const rules = why.rules.map(({ row, column, label, weight }) => {
    const speed = units.text(why.table?.speed_points_kmh[row], 'km/h')
    const rate = why.table?.torque_rate_points[column] ?? '—'
    return `${say('and', { speed, rate })}: ${label} ${weight.toFixed(2)}`
  })
  const rows = waterfall(why).map(
    (row) => `${rowName(row, why, say, units)}: ${rowValue(row, units)}`,
  )
  return [sentence(why, say, units), head, ...rules, ...rows].join('\n')
}

// The eight figures that summarise a ride. A figure that is missing is a dash with its reason.
import type { Ride, RideEnergy } from '$shared/api/types'
import type { Locale } from '$shared/i18n/locale.svelte'
import type { Units } from '$shared/units/units.svelte'
import type { Key, Say } from './words'

export interface Figure {
  name: Key
  token?: 'rider' | 'motor' | 'battery'
  /** Number and unit; null where the ride has none. */
  value: [number: string, unit: string] | null
  /** What it rests on, or why it is missing. */
  note: string
}

interface Speech {
  say: Say
  locale: Locale
  units: Units
}

const SOURCES = {
  odometer: 'odometer',
  speed: 'from_speed',
  positions: 'from_positions',
} as const

/** Rider and motor stand side by side and are never added; their ratio may be given. */
export function headline(
  ride: Ride,
  energy: RideEnergy | null,
  { say, locale, units }: Speech,
  waits = false,
): Figure[] {
  const s = ride.summary
  const has = (name: string) => ride.channels.some((channel) => channel.name === name)
  const figure = (value: number | null | undefined, unit: string): Figure['value'] =>
    value == null ? null : [units.number(value, unit), units.label(unit)]
  const hint = (value: unknown, note: string, missing: Key) =>
    value == null ? say(missing) : note
  const meanTop = (mean: number | null | undefined, top: number | null | undefined) =>
    say('mean_top', { mean: units.text(mean, 'W'), top: units.text(top, 'W') })
  const missing = reasons(ride, has)
  const ratio = s?.rider_wh && s.motor_wh != null ? s.motor_wh / s.rider_wh : null
  return [
    {
      name: 'distance',
      value: figure(s?.distance_km, 'km'),
      note: hint(s?.distance_km, say(SOURCES[s?.distance_source ?? 'speed']), 'none_distance'),
    },
    {
      name: 'moving',
      value: s?.moving_s == null ? null : [locale.duration(s.moving_s), ''],
      note: hint(
        s?.moving_s,
        say('of_time', { time: locale.duration(s?.duration_s) }),
        'none_speed',
      ),
    },
    {
      name: 'mean_speed',
      value: figure(s?.speed_kmh_mean, 'km/h'),
      note: hint(
        s?.speed_kmh_mean,
        say('top', { value: units.text(s?.speed_kmh_max, 'km/h') }),
        has('speed_kmh') ? 'none_moving' : 'none_speed',
      ),
    },
    {
      name: 'climb',
      value: figure(energy?.climb?.ascent_m, 'm of altitude'),
      note: climbNote(energy, has('altitude_m'), waits, { say, units }),
    },
    {
      name: 'your_energy',
      token: 'rider',
      value: figure(s?.rider_wh, 'Wh'),
      note: hint(s?.rider_wh, meanTop(s?.rider_power_w_mean, s?.rider_power_w_max), missing.rider),
    },
    {
      name: 'motor_energy',
      token: 'motor',
      value: figure(s?.motor_wh, 'Wh'),
      note: hint(s?.motor_wh, meanTop(s?.motor_power_w_mean, s?.motor_power_w_max), missing.motor),
    },
    {
      name: 'from_battery',
      token: 'battery',
      value: figure(s?.battery_wh, 'Wh'),
      note: hint(s?.battery_wh, batteryNote(ride, { say, locale, units }), missing.battery),
    },
    {
      name: 'per_yours',
      value: ratio === null ? null : [locale.number(ratio, 2), ''],
      note: hint(ratio, say('wh_for_each'), 'none_ratio'),
    },
  ]
}

/** Why an energy is missing, by what is there. */
function reasons(
  ride: Ride,
  has: (name: string) => boolean,
): Record<'rider' | 'motor' | 'battery', Key> {
  const [volts, amperes] = [has('battery_voltage_v'), has('battery_current_a')]
  return {
    rider: has('rider_torque_nm') && !has('cadence_rpm') ? 'none_cadence' : 'none_rider',
    motor: ride.motor_torque_meaning === 'demanded' ? 'demand_only' : 'none_motor',
    battery: volts === amperes ? 'none_battery' : volts ? 'none_current' : 'none_voltage',
  }
}

function batteryNote({ summary }: Ride, { say, units }: Speech): string {
  const [wh, km] = [summary?.battery_wh ?? 0, summary?.distance_km ?? 0]
  const per_km = units.text(km > 0.1 ? wh / km : null, 'Wh/km')
  const used = summary?.battery_soc_pct_used
  if (used == null) return say('per_km', { per_km })
  return say('battery_used', { share: units.text(used, '%'), per_km })
}

function climbNote(
  energy: RideEnergy | null,
  has_height: boolean,
  waits: boolean,
  { say, units }: Omit<Speech, 'locale'>,
): string {
  if (waits && has_height) return '…'
  if (!energy?.climb) return say(has_height ? 'none_height_distance' : 'none_height')
  return say('of_heights', { descent: units.text(energy.climb.descent_m, 'm of altitude') })
}

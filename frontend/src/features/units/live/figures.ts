// What the page requests of the unit and shows as numbers: four large ones, then eight small.
import type { Dashboard } from '$shared/api/types'
import type { Key } from './words'

export type SummedUp = Exclude<keyof Dashboard, 't_us'>

/** A number of the stream, or one that the server sums up of it once a second. */
export interface Figure {
  word: Key
  unit: string
  digits: number
  channel?: string
  summed?: SummedUp
  token?: string
  /** Motor torque is sent as at the motor's shaft; at the crank it compares with the rider's. */
  at_crank?: true
}

export const LARGE: readonly Figure[] = [
  { word: 'speed', channel: 'speed_kmh', unit: 'km/h', digits: 1, token: 'speed' },
  { word: 'your_power', summed: 'rider_power_w', unit: 'W', digits: 0, token: 'rider' },
  { word: 'motor_power', summed: 'motor_power_w', unit: 'W', digits: 0, token: 'motor' },
  { word: 'cadence', channel: 'cadence_rpm', unit: 'rpm', digits: 0, token: 'cadence' },
]

export const SMALL: readonly Figure[] = [
  { word: 'rider_torque', channel: 'rider_torque_filtered_nm', unit: 'Nm', digits: 1 },
  { word: 'motor_torque', channel: 'motor_torque_nm', unit: 'Nm', digits: 1, at_crank: true },
  { word: 'gain', channel: 'fuzzy_gain', unit: '', digits: 3 },
  { word: 'ratio', channel: 'assist_ratio', unit: '', digits: 2 },
  { word: 'motor', channel: 'motor_temperature_degc', unit: 'degC', digits: 0 },
  { word: 'battery', channel: 'battery_soc_pct', unit: '%', digits: 0 },
  { word: 'distance', summed: 'distance_km', unit: 'km', digits: 2 },
  { word: 'range', summed: 'range_km', unit: 'km', digits: 0 },
]

const DEMANDED = 'motor_torque_demanded_nm'

/** Whether the unit reports the torque that its motor delivers, by its current: one of earlier
    firmware sends as `motor_torque_nm` the demanded torque, and nothing else. */
export function reportsDelivered(channels: readonly { name: string }[] | undefined): boolean {
  return channels?.some((channel) => channel.name === DEMANDED) ?? true
}

/** The average over the stroke stays frozen while the reading it is made of is missing: a frozen
    value is no measurement. */
export const MADE_OF: Readonly<Record<string, string>> = {
  rider_torque_filtered_nm: 'rider_torque_nm',
  torque_rate: 'rider_torque_nm',
}

export const CHANNELS = [
  ...[...LARGE, ...SMALL].flatMap(({ channel }) => channel ?? []),
  DEMANDED,
  'rider_torque_nm',
  'crank_angle_deg',
  'torque_rate',
  'assist_mode',
  'battery_voltage_v',
  'battery_current_a',
  'limit_flags',
  'fault_flags',
  'fault_flags_high',
]

/** The newest values with null for what is frozen. */
export function measured(latest: Readonly<Record<string, number | null>>) {
  const stale = Object.keys(MADE_OF).filter((name) => latest[MADE_OF[name] ?? ''] === null)
  return { ...latest, ...Object.fromEntries(stale.map((name) => [name, null])) }
}

// What the Live page asks for and shows as numbers.

export interface TileSpec {
  channel: string
  unit: string
  token: string
  digits: number
  /** Motor torque is sent as at the motor's shaft; at the crank it compares with the rider's. */
  at_crank?: true
}

export const tiles: TileSpec[] = [
  { channel: 'rider_torque_filtered_nm', unit: 'Nm', token: 'rider', digits: 1 },
  { channel: 'motor_torque_nm', unit: 'Nm', token: 'motor', digits: 1, at_crank: true },
  { channel: 'speed_kmh', unit: 'km/h', token: 'speed', digits: 1 },
  { channel: 'cadence_rpm', unit: 'rpm', token: 'cadence', digits: 0 },
  { channel: 'fuzzy_gain', unit: '', token: 'gain', digits: 3 },
  { channel: 'assist_ratio', unit: '', token: 'ink', digits: 2 },
  { channel: 'battery_voltage_v', unit: 'V', token: 'battery', digits: 1 },
  { channel: 'battery_soc_pct', unit: '%', token: 'battery', digits: 0 },
]

const ASKED = 'motor_torque_demanded_nm'

/** Whether the unit tells what its motor gives, by its current: one of earlier firmware sends as
    `motor_torque_nm` what it asks, and nothing beside it. */
export function tellsWhatIsGiven(channels: readonly { name: string }[] | undefined): boolean {
  return channels?.some((channel) => channel.name === ASKED) ?? true
}

export const CHANNELS = [
  'rider_torque_nm',
  ...tiles.map((tile) => tile.channel),
  ASKED,
  'battery_current_a',
  'torque_rate',
  'limit_flags',
  'fault_flags',
  'fault_flags_high',
  'motor_temperature_degc',
]

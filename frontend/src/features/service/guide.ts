// The guided search: for each fault its likely causes, most likely first, and what the unit's live
// values say of each. The words of a cause are in guide_words, under its name.
import { RESTING_KMH, type FAULTS } from '$generated/registry'
import en from '$messages/en/service.json'

type FaultName = keyof typeof FAULTS
type CauseWord<Key> = Key extends `${infer Cause}.is` ? Cause : never
export type Cause = CauseWord<keyof typeof en>

/** A live value that bears on a cause. points: whether it speaks for the cause, null where it says
    nothing of it; a missing value is handed over as null. */
export interface Proof {
  channel: string
  unit: string
  points: (value: number | null, battery_v_min: number | null) => boolean | null
}

// The limits by which the unit itself sets its faults, and below which it lets them be cleared.
const RAW_COUNTS_MAX = 32767
const WORD_MS_MAX = 250
const ZERO_NM_MAX = 3
const MOTOR_CLEARS_DEGC = 110
const CONTROLLER_CLEARS_DEGC = 85
const CHARGE_PCT_LEAST = 5

const shows = (channel: string, unit: string): Proof => ({ channel, unit, points: () => null })
const above = (channel: string, unit: string, most: number): Proof => ({
  channel,
  unit,
  points: (value) => (value === null ? null : Math.abs(value) > most),
})
const zero = above('rider_torque_nm', 'Nm', ZERO_NM_MAX)
const sensor: Proof = {
  channel: 'rider_torque_raw',
  unit: 'counts',
  points: (value) => value === null || Math.abs(value) >= RAW_COUNTS_MAX,
}
const link: Proof = {
  channel: 'torque_age_ms',
  unit: 'ms',
  points: (value) => value === null || value > WORD_MS_MAX,
}
const voltage: Proof = {
  channel: 'battery_voltage_v',
  unit: 'V',
  points: (value, least) => (value === null || least === null ? null : value < least),
}

/** By which live value a fault is still there; only of faults that one value shows. */
export const CONDITIONS: Readonly<Partial<Record<FaultName, Proof>>> = {
  torque_sensor: sensor,
  torque_drift: zero,
  foot_at_start: zero,
  torque_link: link,
  battery_low: voltage,
  under_voltage: voltage,
  motor_temperature: above('motor_temperature_degc', 'degC', MOTOR_CLEARS_DEGC),
  controller_temperature: above('controller_temperature_degc', 'degC', CONTROLLER_CLEARS_DEGC),
}

/** What to check for each cause; null where no live value shows it. */
export const PROOFS: Readonly<Record<Cause, Proof | null>> = {
  spindle_plug: sensor,
  bridge_arm: sensor,
  rotor_supply: link,
  coil_gap: link,
  amplifier: shows('rider_torque_raw', 'counts'),
  foot_on_pedal: zero,
  zero_moved: zero,
  gauge_bond: zero,
  magnet: shows('speed_kmh', 'km/h'),
  speed_cable: shows('speed_kmh', 'km/h'),
  foreign_pulses: above('speed_kmh', 'km/h', RESTING_KMH),
  wheel_settings: null,
  battery_empty: {
    channel: 'battery_soc_pct',
    unit: '%',
    points: (value) => (value === null ? null : value < CHARGE_PCT_LEAST),
  },
  battery_contacts: voltage,
  battery_worn: voltage,
  battery_switch: null,
  motor_phase: shows('motor_current_a', 'A'),
  gear_drags: shows('motor_current_a', 'A'),
  power_stage: null,
  hot_ride: shows('motor_temperature_degc', 'degC'),
  motor_thermometer: shows('motor_temperature_degc', 'degC'),
  hot_controller: shows('controller_temperature_degc', 'degC'),
  heat_path: shows('controller_temperature_degc', 'degC'),
  hall_plug: shows('motor_speed_rpm', 'rpm'),
  hall_signal: shows('motor_speed_rpm', 'rpm'),
  water: null,
  supply_dips: voltage,
  settings_damaged: null,
  flash_worn: null,
  program: null,
  never_set_up: null,
}

/** The likely causes of every fault of the registry, most likely first. */
export const CAUSES: Readonly<Record<FaultName, readonly Cause[]>> = {
  torque_sensor: ['spindle_plug', 'bridge_arm', 'rotor_supply'],
  speed_sensor: ['magnet', 'speed_cable', 'foreign_pulses'],
  battery_low: ['battery_empty', 'battery_contacts', 'battery_worn'],
  config_defaulted: ['settings_damaged', 'flash_worn'],
  over_current: ['gear_drags', 'motor_phase', 'power_stage'],
  under_voltage: ['battery_contacts', 'battery_empty', 'battery_worn'],
  battery_cut: ['battery_switch', 'battery_empty', 'battery_worn'],
  motor_temperature: ['hot_ride', 'gear_drags', 'motor_thermometer'],
  controller_temperature: ['hot_controller', 'heat_path'],
  torque_stuck: ['amplifier', 'spindle_plug', 'rotor_supply'],
  torque_drift: ['zero_moved', 'gauge_bond'],
  torque_link: ['coil_gap', 'rotor_supply'],
  foot_at_start: ['foot_on_pedal', 'zero_moved', 'amplifier'],
  speed_mismatch: ['magnet', 'wheel_settings', 'speed_cable'],
  speed_stuck: ['foreign_pulses', 'speed_cable', 'magnet'],
  motor_hall: ['hall_plug', 'hall_signal', 'motor_phase', 'gear_drags'],
  law_result: ['program'],
  safe_stop: ['water', 'supply_dips', 'program'],
  not_provisioned: ['never_set_up'],
}

/** The causes of a fault; none of one that a newer firmware has. */
export function causesOf(fault: string): readonly Cause[] {
  return (CAUSES as Record<string, readonly Cause[]>)[fault] ?? []
}

/** The live value by which a fault is still there; null where no single one shows it. */
export function conditionOf(fault: string): Proof | null {
  return (CONDITIONS as Record<string, Proof>)[fault] ?? null
}

// Which part of the unit a fault is about, for lamps, checks and whatever else shows a reading.

export const PARTS = ['torque', 'speed', 'motor', 'battery', 'link', 'firmware'] as const
export type Part = (typeof PARTS)[number]

/** Which faults are about which part; every other one is about none of them. */
const FAULTS_OF: Record<Part, readonly string[]> = {
  torque: ['torque_sensor', 'torque_stuck', 'torque_drift', 'foot_at_start'],
  speed: ['speed_sensor', 'speed_mismatch', 'speed_stuck'],
  motor: ['motor_temperature', 'controller_temperature', 'motor_hall', 'over_current'],
  battery: ['battery_low', 'battery_cut', 'under_voltage'],
  link: ['torque_link'],
  firmware: ['config_defaulted', 'law_result', 'safe_stop', 'not_provisioned'],
}

/** The first of a unit's faults that is about a part; null for none. */
export function faultOf(part: Part, faults_active: readonly string[]): string | null {
  return FAULTS_OF[part].find((one) => faults_active.includes(one)) ?? null
}

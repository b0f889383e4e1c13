// The six lamps of a unit: whether each part is well by the unit's own word, and one number of it.
import type { Device, SensorDrift } from '$shared/api/types'

export const LAMPS = ['torque', 'speed', 'motor', 'battery', 'link', 'firmware'] as const
export type LampName = (typeof LAMPS)[number]

/** unknown: nothing says how it is, as nothing does while the unit is away. */
export interface Lamp {
  name: LampName
  state: 'ok' | 'warn' | 'bad' | 'unknown'
  /** The first fault that is about it; null for none. */
  fault: string | null
}

/** Which faults are about which part; every other one is about none of them. */
const FAULTS_OF: Record<LampName, readonly string[]> = {
  torque: ['torque_sensor', 'torque_stuck', 'torque_drift', 'foot_at_start'],
  speed: ['speed_sensor', 'speed_mismatch', 'speed_stuck'],
  motor: ['motor_temperature', 'controller_temperature', 'motor_hall', 'over_current'],
  battery: ['battery_low', 'battery_cut', 'under_voltage'],
  link: ['torque_link'],
  firmware: ['config_defaulted', 'law_result', 'safe_stop', 'not_provisioned'],
}

/** How a unit's parts are. connected: whether it answers now; else nobody knows. zero: how far the
    torque sensor's zero has moved by its rides. */
export function lampsOf(
  device: Device,
  connected: boolean,
  zero: SensorDrift['level'] = null,
): Lamp[] {
  return LAMPS.map((name) => {
    const fault = FAULTS_OF[name].find((one) => device.faults_active.includes(one)) ?? null
    if (!connected) return { name, state: 'unknown', fault: null }
    const moved = name === 'torque' && zero !== null && zero !== 'ok'
    return { name, state: fault ? 'bad' : moved ? 'warn' : 'ok', fault }
  })
}

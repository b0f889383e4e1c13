// The six lamps of a unit: whether each part is well by the unit's own word, and one number of it.
import type { Device, SensorDrift } from '$shared/api/types'
import { faultOf, PARTS, type Part } from '$shared/device/fault_parts'

/** unknown: nothing says how it is, as nothing does while the unit is away. */
export interface Lamp {
  name: Part
  state: 'ok' | 'warn' | 'bad' | 'unknown'
  /** The first fault that is about it; null for none. */
  fault: string | null
}

/** How a unit's parts are. connected: whether it answers now; else its state is unknown. zero: how
    far the torque sensor's zero has moved by its rides. */
export function lampsOf(
  device: Device,
  connected: boolean,
  zero: SensorDrift['level'] = null,
): Lamp[] {
  return PARTS.map((name) => {
    const fault = faultOf(name, device.faults_active)
    if (!connected) return { name, state: 'unknown', fault: null }
    const moved = name === 'torque' && zero !== null && zero !== 'ok'
    return { name, state: fault ? 'bad' : moved ? 'warn' : 'ok', fault }
  })
}

// What of an older configuration can be restored, in parts that are ticked one by one.
import type { Comparison, Parameter } from '$shared/api/types'

/** A group of settings that differ; of_the_unit: measured on this bike, so that it is restored only
    on request. */
export interface RestoredPart {
  key: string
  group: string
  of_the_unit: boolean
  names: string[]
}

/** The parts that differ from the older configuration, in the order of the parameters, without
    what only the factory may change. The record of a calibration is one part with what it
    measured. */
export function restoredParts(
  differences: Comparison['parameters'],
  parameters: readonly Parameter[],
): RestoredPart[] {
  const parts = new Map<string, RestoredPart>()
  for (const { name, access, of_the_unit, group } of parameters) {
    const differs = differences.some((one) => one.name === name && one.new !== null)
    if (!differs || access === 'factory') continue
    const shown = of_the_unit && group === 'sensor' ? 'calibration' : group
    const key = `${of_the_unit ? 'unit' : 'tuning'}/${shown}`
    const part = parts.get(key) ?? { key, group: shown, of_the_unit, names: [] }
    part.names.push(name)
    parts.set(key, part)
  }
  return [...parts.values()]
}

// A unit's configuration as a file, as `spindle device backup` writes it: `spindle device restore`,
// `diff` and the library read it.
import type { Config, Device, Parameter } from '$shared/api/types'

/** A unit's name as a part of a file's name. */
export const fileName = (name: string) => name.replaceAll(/[^\w-]+/g, '-')

/** Name and text of the file. */
export function backupOf(
  device: Device,
  config: Config,
  parameters: readonly Parameter[],
): { file: string; text: string } {
  const units = new Map(parameters.map(({ name, unit }) => [name, unit]))
  const entries = Object.entries(config.parameters).map(
    ([name, value]) => [name, { value, unit: units.get(name) ?? '' }] as const,
  )
  const name = device.identity?.serial_number ?? device.id
  const saved = {
    format: 'spindle-configuration',
    version: 1,
    name,
    comment: '',
    family: device.family,
    parameters: Object.fromEntries(entries),
    identity: device.identity,
    unit_key: config.unit_key,
    generation: config.generation,
    crc32: config.crc32,
  }
  const file = `spindle-${fileName(name)}-generation-${config.generation}.json`
  return { file, text: `${JSON.stringify(saved, null, 2)}\n` }
}

// Limits that go down freely and up only with the maker's token. The unit decides; this only shows
// the reader beforehand.
import { PARAMETERS, type ParameterRow } from '$generated/registry'
import type { ConfigChange, Parameter, ParameterValue } from '../api/types'

export type RatchetMove = 'lowered' | 'raised'

const rows: Readonly<Record<string, ParameterRow>> = PARAMETERS

/** Whether a parameter goes down freely and up only with a token. */
export function isRatchet(name: string): boolean {
  return rows[name]?.ratchet ?? false
}

/** Whether a parameter is the factory's own, which only a token changes. */
export function isFactorys(parameter: Parameter): boolean {
  return parameter.access === 'factory'
}

/** Which way such a limit would go; null for any other change. */
export function ratchetMove(
  name: string,
  old: ParameterValue | null,
  value: ParameterValue | null,
): RatchetMove | null {
  if (!isRatchet(name) || typeof old !== 'number' || typeof value !== 'number') return null
  if (value === old) return null
  return value < old ? 'lowered' : 'raised'
}

/** Whether the unit will require the maker's token: a factory's parameter, a limit that goes up, or
    a value further from the factory's than a dealer may set. */
export function needsToken(
  parameter: Parameter,
  old: ParameterValue | null,
  value: ParameterValue | null,
): boolean {
  if (value === old) return false
  const { free, name } = parameter
  if (isFactorys(parameter) || ratchetMove(name, old, value) === 'raised') return true
  return free != null && typeof value === 'number' && !(value >= free.min && value <= free.max)
}

/** Whether writing the old values back would need a token. */
export function cannotBeUndone(change: ConfigChange): boolean {
  return change.changed.some((c) => ratchetMove(c.name, c.old, c.new) === 'lowered')
}

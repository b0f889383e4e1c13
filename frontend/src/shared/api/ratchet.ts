// Limits that go down freely and up only with the maker's token. The unit decides; this only tells
// the reader beforehand.
import { PARAMETERS, type ParameterRow } from '$generated/registry'
import type { ConfigChange, ParameterValue } from './types'

export type RatchetMove = 'lowered' | 'raised'

const rows: Readonly<Record<string, ParameterRow>> = PARAMETERS

/** Whether a parameter goes down freely and up only with a token. */
export function isRatchet(name: string): boolean {
  return rows[name]?.ratchet ?? false
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

/** Whether writing the old values back would need a token. */
export function cannotBeUndone(change: ConfigChange): boolean {
  return change.changed.some((c) => ratchetMove(c.name, c.old, c.new) === 'lowered')
}

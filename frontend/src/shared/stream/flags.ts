// Numbers that are sets of flags.
import { FLAGS } from '$generated/registry'

const HALF = 2 ** 16

/** The faults of a row as one number: two channels carry them, and a unit of earlier firmware has
    only the first. Null where the unit did not send it. */
export function faultFlags(row: Readonly<Record<string, number | null | undefined>>) {
  const low = row['fault_flags'] ?? null
  return low === null ? null : low + (row['fault_flags_high'] ?? 0) * HALF
}

/** Names of the flags that are set, in the registry's order. */
export function flagNames(table: keyof typeof FLAGS, word: number | null): string[] {
  const bits: Readonly<Record<string, number>> = FLAGS[table]
  if (word === null) return []
  return Object.keys(bits).filter((name) => word & (1 << (bits[name] ?? 0)))
}

// What a unit can do, as it says itself. Pages offer nothing else.
import type { Device } from '../api/types'

export type Capability = Device['capabilities'][number]

/** What a page is about; a unit that cannot do it has no such page. */
const NEEDED = {
  live: ['stream'],
  tune: ['read_config'],
  sensor: ['rider_torque', 'stream'],
} as const satisfies Record<string, readonly Capability[]>

export type UnitPage = keyof typeof NEEDED
/** What a page says of itself when it is opened all the same. */
export type Needed = (typeof NEEDED)[UnitPage][number]

/** Whether a unit can do something. Nothing is denied where there is no unit to ask. */
export function can(device: Device | null | undefined, capability: Capability): boolean {
  return device?.capabilities.includes(capability) ?? true
}

/** The first thing a page needs that the unit cannot do; null for a page that works. */
export function missingFor(device: Device | null, page: UnitPage): Needed | null {
  return NEEDED[page].find((capability) => !can(device, capability)) ?? null
}

/** Whether a unit has a page; pages that need no unit are always there. */
export function hasPage(device: Device | null, page: string): boolean {
  return !(page in NEEDED) || missingFor(device, page as UnitPage) === null
}

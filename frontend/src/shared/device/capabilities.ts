// What a unit can do, as it says itself. Pages offer nothing else.
import type { Device } from '../api/types'

export type Capability =
  | 'read_config'
  | 'write_config'
  | 'unit_trial'
  | 'stream'
  | 'rider_torque'
  | 'calibrate'
  | 'live_set'
  | 'logs'
  | 'unlock'
  | 'unit_limits'
  | 'unique_id'
  | 'restart_to_apply'
  | 'fuzzy_table'
  | 'assist_modes'
  | 'limits'
  | 'simulation'

/** What a page is about; a unit that cannot do it has no such page. */
const NEEDED = {
  live: ['stream'],
  tune: ['read_config'],
  sensor: ['rider_torque', 'stream'],
} as const satisfies Record<string, readonly Capability[]>

export type UnitPage = keyof typeof NEEDED
/** What a page says of itself when it is opened all the same. */
export type Needed = (typeof NEEDED)[UnitPage][number]

// A server that does not list capabilities knows only units that have all of them.
type Listing = Device & { capabilities?: readonly string[] }

/** Whether a unit can do something. One that has listed nothing yet is not denied anything. */
export function can(device: Device | null | undefined, capability: Capability): boolean {
  const listed = (device as Listing | null | undefined)?.capabilities ?? []
  return listed.length === 0 || listed.includes(capability)
}

/** The first thing a page needs that the unit cannot do; null for a page that works. */
export function missingFor(device: Device | null, page: UnitPage): Needed | null {
  return NEEDED[page].find((capability) => !can(device, capability)) ?? null
}

/** Whether a unit has a page; pages that need no unit are always there. */
export function hasPage(device: Device | null, page: string): boolean {
  return !(page in NEEDED) || missingFor(device, page as UnitPage) === null
}

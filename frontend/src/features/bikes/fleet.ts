// The bikes of a workshop as one looks for them: what is known of each now, and which are shown.
import type { Bike } from '$shared/api/bike_server'
import type { Device } from '$shared/api/types'
import { faultTone } from '$shared/device/fault_text'

/** What comes first of a bike. away: nothing is known of its unit now. */
export type Standing = 'lost' | 'fault' | 'warning' | 'sound' | 'away' | 'no_unit'
export const FILTERS = ['all', 'fault', 'ownerless', 'lost', 'unseen'] as const
export type Filter = (typeof FILTERS)[number]

export interface FleetBike {
  bike: Bike
  /** Its unit, where that is connected now. */
  device: Device | null
  standing: Standing
}

export const UNSEEN_DAYS = 30
const DAY_MS = 86_400_000

/** Whether a unit answers, whatever may be written to it. */
export const isConnected = ({ state }: Device): boolean =>
  state === 'ready' || state === 'read_only'

export function fleetOf(bikes: readonly Bike[], devices: readonly Device[]): FleetBike[] {
  return bikes.map((bike) => {
    const device = devices.find((one) => one.bike_id === bike.id && isConnected(one)) ?? null
    return { bike, device, standing: standingOf(bike, device) }
  })
}

function standingOf(bike: Bike, device: Device | null): Standing {
  if (bike.lost_at) return 'lost'
  if (!device) return bike.unit ? 'away' : 'no_unit'
  const tone = faultTone(device)
  return tone === 'bad' ? 'fault' : tone === 'warn' ? 'warning' : 'sound'
}

/** Whether a bike is of a kind; now_ms: Unix time. */
export function isOf(filter: Filter, { bike, device }: FleetBike, now_ms: number): boolean {
  switch (filter) {
    case 'all':
      return true
    case 'fault':
      return device !== null && device.faults_active.length > 0
    case 'ownerless':
      return bike.owner === null
    case 'lost':
      return bike.lost_at !== null
    case 'unseen':
      if (device || !bike.unit) return false
      return now_ms - Date.parse(bike.unit.last_seen_at) > UNSEEN_DAYS * DAY_MS
  }
}

/** Whether every word that was typed is somewhere in what a bike is known by. */
export function isFound(typed: string, { bike }: FleetBike): boolean {
  const { name, model, frame_number, owner, unit } = bike
  const known = [name, model, frame_number, owner?.name, unit?.serial_number, unit?.model]
  const text = known.join(' ').toLowerCase()
  const parts = typed.toLowerCase().split(/\s+/)
  return parts.every((part) => text.includes(part))
}

const STEPS = [
  ['day', 86_400],
  ['hour', 3600],
  ['minute', 60],
] as const

/** How long ago in the largest measure that fits, at least a minute: [3, 'hour']. */
export function ageOf(age_s: number): [number, Intl.RelativeTimeFormatUnit] {
  const [measure, seconds] = STEPS.find(([, seconds]) => age_s >= seconds) ?? STEPS[2]
  return [Math.max(1, Math.floor(age_s / seconds)), measure]
}

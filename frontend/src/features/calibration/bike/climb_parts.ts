// The parts of a climb's question, and its answer as bars.
import type { ClimbResult, Slope } from './bike_server'

export interface Part {
  kind: 'climb' | 'coast'
  ride_id: number
  from_s: number | null
  to_s: number | null
  /** Null, or no number yet: by the ride's heights, where it has them. */
  rise_m: number | null
  /** By the ride's own heights. */
  heights: boolean
}

export interface Bar {
  key: 'legs' | 'motor' | 'gravity' | 'kinetic' | 'rolling' | 'air' | 'drivetrain'
  /** Null where not measured. */
  wh: number | null
  /** Of the longest, 0 to 1. */
  share: number
}

const J_PER_WH = 3600

/** Another part besides those chosen: there is one climb, and any number of coast-downs. */
export function withPart(parts: readonly Part[], part: Part): Part[] {
  const others = part.kind === 'climb' ? parts.filter(({ kind }) => kind !== 'climb') : [...parts]
  return part.kind === 'climb' ? [part, ...others] : [...others, part]
}

/** As sent: without an entered height, by the ride's. */
export function asSlope({ ride_id, from_s, to_s, rise_m }: Part): Slope {
  const terms = rise_m !== null && Number.isFinite(rise_m)
  return { ride_id, from_s, to_s, rise_m: terms ? rise_m : null }
}

/** What gave and what took, each by itself: legs and motor are never added. */
export function barsOf({ balance }: ClimbResult): Bar[] {
  const { needed } = balance
  const terms: [Bar['key'], number | null][] = [
    ['legs', balance.crank_energy_j],
    ['motor', balance.motor_energy_j],
    ['gravity', needed.gravity_j],
    ['kinetic', needed.kinetic_j],
    ['rolling', needed.rolling_j],
    ['air', needed.air_j],
    ['drivetrain', needed.drivetrain_j],
  ]
  const most = Math.max(...terms.map(([, joules]) => Math.abs(joules ?? 0)), 1)
  return terms.map(([key, joules]) => ({
    key,
    wh: joules === null ? null : joules / J_PER_WH,
    share: Math.abs(joules ?? 0) / most,
  }))
}

/** What leaves the ratio open, the largest first, as shares. */
export function causesOf({ balance }: ClimbResult): [string, number][] {
  return Object.entries(balance.contributions).sort(([, a], [, b]) => b - a)
}

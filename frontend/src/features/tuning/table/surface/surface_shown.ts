// What the surface shows: the table's gain, or what comes of it at the crank for a steady push.
import type { TorqueSurface } from '$shared/api/types'
import { flagNames } from '$shared/stream/flags'
import type { GainSurface } from './surface_preview.svelte'
import type { Place } from './trail.svelte'

export const SHOWN = ['gain', 'demanded_nm', 'delivered_nm', 'demanded_w', 'delivered_w'] as const
export type Shown = (typeof SHOWN)[number]

/** The largest gain a table can hold: a fixed scale makes edits comparable. */
export const GAIN_MAX = 0.5
/** What is less than this is rounding, not a limit. */
const TAKEN_SHARE = 0.005

export interface Picture {
  shown: Shown
  speeds_kmh: number[]
  torque_rates: number[]
  /** Values in SI, rows = speeds. */
  z: number[][]
  top: number
  unit: '' | 'Nm' | 'W'
  /** What the law demands where the delivered torque is shown; null for anything else. */
  demanded: number[][] | null
  /** By which limits it is less than that; null for anything else. */
  taken_by: string[][][] | null
}

/** The input of what draws a picture. */
export interface Drawn {
  picture: Picture
  /** What is shown, with its unit. */
  name: string
  titles: { speed: string; rate: string }
  /** What a place of the grid says, line by line. */
  read: (row: number, column: number) => string[]
  /** The place of the chosen rule. */
  chosen: Place
  point: Place | null
  trail: Place[]
}

const TRANSIENT_LIMITS = ['ramp_up', 'ramp_down', 'taper']

/** The picture of the requested quantity; of the gain until the torque is there. top_nm: of the
    scale, at the crank. */
export function pictureOf(
  requested: Shown,
  gain: GainSurface | null,
  torque: TorqueSurface | null,
  top_nm: number,
): Picture | null {
  if (requested === 'gain' || !torque) {
    if (!gain) return null
    const plain = { top: GAIN_MAX, unit: '' as const, demanded: null, taken_by: null }
    return { shown: 'gain', ...gain, z: gain.gain, ...plain }
  }
  const { speeds_kmh, torque_rates, limit_flags } = torque
  const watts = requested.endsWith('_w')
  const times = (rows: number[][]) =>
    watts ? rows.map((row) => row.map((nm) => nm * torque.crank_rad_per_s)) : rows
  const frame = {
    shown: requested,
    speeds_kmh,
    torque_rates,
    top: watts ? top_nm * torque.crank_rad_per_s : top_nm,
    unit: watts ? ('W' as const) : ('Nm' as const),
  }
  if (requested.startsWith('demanded')) {
    return { ...frame, z: times(torque.demanded_nm), demanded: null, taken_by: null }
  }
  const taken_by = torque.delivered_nm.map((row, i) =>
    row.map((given, j) => {
      const demanded = torque.demanded_nm[i]?.[j] ?? 0
      if (demanded - given <= TAKEN_SHARE * demanded) return []
      return flagNames('limit_flags', limit_flags[i]?.[j] ?? 0).filter(
        (name) => !TRANSIENT_LIMITS.includes(name),
      )
    }),
  )
  return { ...frame, z: times(torque.delivered_nm), demanded: times(torque.demanded_nm), taken_by }
}

/** Every limit that takes something anywhere, and how much of the grid it is. */
export function takers(picture: Picture): { name: string; share: number }[] {
  const places = picture.taken_by?.flat() ?? []
  const names = [...new Set(places.flat())]
  return names
    .map((name) => ({
      name,
      share: places.filter((at) => at.includes(name)).length / places.length,
    }))
    .sort((a, b) => b.share - a.share)
}

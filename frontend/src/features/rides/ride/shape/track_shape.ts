// A track drawn: points of a ride in pixels, in segments of one mode, with marks at whole
// kilometres.
import type { Track } from '$shared/api/types'
import { LaidAxis } from '$shared/charts/traces/trace_axis'
import { niceStep } from '$shared/charts/plot_axis'
import type { ModeSpan } from './modes'
import { modeAt } from './modes'

const M_PER_DEG = 111_195 // of a great circle, mean radius 6371 km

export interface Spot {
  x: number
  y: number
}

export interface Segment {
  mode: number | null
  points: Spot[]
}

export interface KmMark extends Spot {
  /** In the reader's unit of way. */
  distance: number
}

/** Local equirectangular: metres east and south of the first position, true at the mean latitude;
    fitted into a drawing with north up. */
export class TrackShape {
  readonly begin: Spot
  readonly end: Spot
  readonly m_per_px: number
  private readonly east: LaidAxis
  private readonly south: LaidAxis

  private constructor(
    private readonly points: { t_s: number[]; x: number[]; y: number[] },
    private readonly open: [from_s: number, to_s: number][],
    m_per_px: number,
  ) {
    const last = points.t_s.length - 1
    this.m_per_px = m_per_px
    this.east = new LaidAxis('time', points.t_s, points.x)
    this.south = new LaidAxis('time', points.t_s, points.y)
    this.begin = { x: points.x[0] ?? 0, y: points.y[0] ?? 0 }
    this.end = { x: points.x[last] ?? 0, y: points.y[last] ?? 0 }
  }

  /** null for a ride without positions. */
  static of(track: Track, width: number, height: number, margin: number): TrackShape | null {
    const { t_s, latitude_deg, longitude_deg } = track
    if (!latitude_deg || !longitude_deg) return null
    const points: { t_s: number[]; x: number[]; y: number[] } = { t_s: [], x: [], y: [] }
    const gaps: [number, number][] = []
    let silent = false
    let before: number | null = null
    for (const [i, latitude] of latitude_deg.entries()) {
      const longitude = longitude_deg[i] ?? null
      const at_s = t_s[i] ?? 0
      if (latitude === null || longitude === null) {
        silent = true
        continue
      }
      // The shorter way round the earth from the point before.
      const round: number = before === null ? 0 : Math.round((before - longitude) / 360) * 360
      before = longitude + round
      if (silent && points.t_s.length > 0) gaps.push([points.t_s.at(-1) ?? 0, at_s])
      silent = false
      points.t_s.push(at_s)
      points.x.push(before)
      points.y.push(-latitude)
    }
    if (points.t_s.length < 2) return null
    const mean = -points.y.reduce((sum, one) => sum + one, 0) / points.y.length
    const narrow = Math.cos((mean * Math.PI) / 180)
    points.x = points.x.map((degrees) => degrees * narrow * M_PER_DEG)
    points.y = points.y.map((degrees) => degrees * M_PER_DEG)
    const [left, right] = extent(points.x)
    const [top, bottom] = extent(points.y)
    const m_per_px = Math.max(
      (right - left) / (width - 2 * margin),
      (bottom - top) / (height - 2 * margin),
      0.05, // a bike that never moved is a dot
    )
    const fit = (middle: number, size: number) => (at: number) =>
      (at - middle) / m_per_px + size / 2
    points.x = points.x.map(fit((left + right) / 2, width))
    points.y = points.y.map(fit((top + bottom) / 2, height))
    return new TrackShape(points, gaps, m_per_px)
  }

  /** Where the bike was; null in a gap. */
  at(t_s: number): Spot | null {
    if (this.open.some(([from_s, to_s]) => t_s > from_s && t_s < to_s)) return null
    return { x: this.east.at(t_s), y: this.south.at(t_s) }
  }

  /** The moment at which the track passes nearest to a place of the drawing. */
  nearest({ x, y }: Spot): number {
    let [best, nearest_s] = [Infinity, 0]
    for (const [i, t_s] of this.points.t_s.entries()) {
      const off = Math.hypot((this.points.x[i] ?? 0) - x, (this.points.y[i] ?? 0) - y)
      if (off < best) [best, nearest_s] = [off, t_s]
    }
    return nearest_s
  }

  /** Lines of one mode each, none over a gap, from one moment to another. */
  segments(modes: readonly ModeSpan[], from_s = -Infinity, to_s = Infinity): Segment[] {
    const { t_s } = this.points
    const first = Math.max(from_s, t_s[0] ?? 0)
    const last = Math.min(to_s, t_s.at(-1) ?? 0)
    const edges = [
      first,
      last,
      ...modes.flatMap((span) => [span.from_s, span.to_s]),
      ...this.open.flat(),
    ].filter((at_s) => at_s >= first && at_s <= last)
    const sorted = [...new Set(edges)].sort((a, b) => a - b)
    return sorted.slice(1).flatMap((end_s, i) => {
      const begin_s = sorted[i] ?? 0
      const middle_s = (begin_s + end_s) / 2
      if (this.at(middle_s) === null) return []
      const inner = t_s.filter((at_s) => at_s > begin_s && at_s < end_s)
      const spot = (at_s: number) => ({ x: this.east.at(at_s), y: this.south.at(at_s) })
      return { mode: modeAt(modes, middle_s), points: [begin_s, ...inner, end_s].map(spot) }
    })
  }

  /** Some five marks at round kilometres, or miles: m_per_unit metres each. */
  marks(track: Track, m_per_unit: number): KmMark[] {
    const { distance_m } = track
    if (!distance_m) return []
    const distance = new LaidAxis('distance', track.t_s, distance_m)
    const total = (distance_m.at(-1) ?? 0) / m_per_unit
    const step = Math.max(niceStep(total / 6), 0.1)
    const count = Math.floor(total / step - 1e-9)
    return Array.from({ length: count }, (_, i) => (i + 1) * step).flatMap((at) => {
      const spot = this.at(distance.moment(at * m_per_unit))
      return spot ? { distance: Number(at.toFixed(1)), ...spot } : []
    })
  }
}

function extent(values: number[]): [number, number] {
  return [
    values.reduce((a, b) => Math.min(a, b), Infinity),
    values.reduce((a, b) => Math.max(a, b), -Infinity),
  ]
}

/** A round length of the scale, in m, at most so many pixels. */
export function scaleLength(m_per_px: number, px: number, m_per_unit: number): number {
  const most = (m_per_px * px) / m_per_unit
  const ten = 10 ** Math.floor(Math.log10(most))
  const round = [5, 2, 1].find((one) => one * ten <= most) ?? 1
  return round * ten * m_per_unit
}

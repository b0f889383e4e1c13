// The same road three times, as lines of a picture: over the distance or each ride's own time.
import type { RideCurves } from '$shared/api/types'
import { niceStep } from '$shared/charts/plot_axis'

export const RIDES = ['recorded', 'unchanged', 'replayed'] as const
export type RideName = (typeof RIDES)[number]
export type RoadAxis = 'km' | 'time'
export type Channel = 'motor_torque_nm' | 'speed_kmh'
type Numbers = readonly (number | null)[]

/** A range of values laid over a stretch of pixels, which may run upwards. */
export class Scale {
  constructor(
    readonly from: number,
    readonly to: number,
    readonly start_px: number,
    readonly length_px: number,
  ) {}

  px(value: number): number {
    return this.start_px + ((value - this.from) / (this.to - this.from || 1)) * this.length_px
  }

  value(px: number): number {
    return this.from + ((px - this.start_px) / (this.length_px || 1)) * (this.to - this.from)
  }

  /** Round values in the range, about `count`. */
  ticks(count: number): number[] {
    const step = niceStep((this.to - this.from || 1) / count)
    const first = Math.ceil(this.from / step - 1e-9)
    const last = Math.floor(this.to / step + 1e-9)
    return Array.from({ length: last - first + 1 }, (_, i) => (first + i) * step)
  }
}

/** Where a ride's points lie along the picture: km, or seconds since its own start. */
export function positionsOf(curves: RideCurves, ride: RideName, by: RoadAxis): Numbers {
  return by === 'km' ? curves.distance_km : curves[ride].t_s
}

/** The end of the picture: of the longest ride by time. */
export function endOf(curves: RideCurves, by: RoadAxis): number {
  const ends = RIDES.flatMap((ride) => positionsOf(curves, ride, by).filter((v) => v !== null))
  return Math.max(1e-9, ...ends)
}

/** The largest value any ride comes to. */
export function topOf(curves: RideCurves, channel: Channel): number {
  return Math.max(1e-9, ...RIDES.flatMap((ride) => curves[ride][channel].map((v) => v ?? 0)))
}

/** What the candidate gives more than the ride's own table, at each place. */
export function difference(curves: RideCurves, channel: Channel): (number | null)[] {
  return curves.replayed[channel].map((value, i) => {
    const own = curves.unchanged[channel][i]
    return value === null || own == null ? null : value - own
  })
}

/** A line through what is there; a gap stays open. */
export function linePath(xs: Numbers, ys: Numbers, x: Scale, y: Scale): string {
  let open = false
  return ys
    .map((value, i) => {
      const at = xs[i]
      if (value === null || at == null) {
        open = false
        return ''
      }
      const pen = open ? 'L' : 'M'
      open = true
      return `${pen}${x.px(at).toFixed(1)} ${y.px(value).toFixed(1)}`
    })
    .join('')
}

/** Bars from 0, those above it or those below it. */
export function barPath(xs: Numbers, ys: Numbers, x: Scale, y: Scale, above: boolean): string {
  const zero = y.px(0).toFixed(1)
  return ys
    .map((value, i) => {
      const [at, next] = [xs[i], xs[i + 1]]
      if (value === null || at == null || value === 0 || value > 0 !== above) return ''
      const [from, to] = [x.px(at), x.px(next ?? at)]
      return `M${from.toFixed(1)} ${zero}V${y.px(value).toFixed(1)}H${to.toFixed(1)}V${zero}`
    })
    .join('')
}

/** The stretch that a place of the picture is in. */
export function nearest(xs: Numbers, value: number): number {
  let best = 0
  xs.forEach((at, i) => {
    const than = xs[best]
    if (at !== null && (than == null || Math.abs(at - value) < Math.abs(than - value))) best = i
  })
  return best
}

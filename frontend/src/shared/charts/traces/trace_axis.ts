// What lies across the traces: time, time in motion, or way. Windows and cursors are moments of the
// ride whatever the axis; here they become places of it, and back.
import type { Series } from '$shared/api/series'
import { niceStep } from '$shared/charts/plot_axis'
import { timeTicks } from './trace_line'
import type { Units } from '$shared/units/units.svelte'

export type AxisKind = 'time' | 'moving' | 'distance'

export interface TraceAxis {
  readonly kind: AxisKind
  /** Seconds, or metres, at a moment. */
  at(t_s: number): number
  /** The first moment at a place: a bike may stand there for long. */
  moment(x: number): number
}

export const timeAxis: TraceAxis = { kind: 'time', at: (t_s) => t_s, moment: (x) => x }

/** Laid over time by points of the ride, a straight line between two of them. */
export class LaidAxis implements TraceAxis {
  constructor(
    readonly kind: AxisKind,
    private readonly t_s: ArrayLike<number>,
    private readonly x: ArrayLike<number>,
  ) {}

  at(t_s: number): number {
    return between(this.t_s, this.x, t_s)
  }

  moment(x: number): number {
    return between(this.x, this.t_s, x)
  }

  /** The same axis, with the very rows of a series where it has some. */
  refined(series: Series): LaidAxis {
    const { t_first_s, t_last_s, x_first, x_last } = series
    if (!x_first || !x_last || x_first.length === 0) return this
    const begin_s = t_first_s[0] ?? 0
    const end_s = t_last_s[t_last_s.length - 1] ?? 0
    const t_s: number[] = []
    const x: number[] = []
    const skip = (outside: (t_s: number) => boolean) => {
      for (let i = 0; i < this.t_s.length; i++) {
        const at_s = this.t_s[i] ?? 0
        if (!outside(at_s)) continue
        t_s.push(at_s)
        x.push(this.x[i] ?? 0)
      }
    }
    skip((at_s) => at_s < begin_s)
    for (let i = 0; i < x_first.length; i++) {
      t_s.push(t_first_s[i] ?? 0, t_last_s[i] ?? 0)
      x.push(x_first[i] ?? 0, x_last[i] ?? 0)
    }
    skip((at_s) => at_s > end_s)
    return new LaidAxis(this.kind, t_s, x)
  }
}

/** y at a place of x, which never falls; of several places of the same x the first. */
function between(xs: ArrayLike<number>, ys: ArrayLike<number>, x: number): number {
  let [low, high] = [0, xs.length - 1]
  if (high < 0) return 0
  while (low < high) {
    const middle = (low + high) >> 1
    if ((xs[middle] ?? 0) < x) low = middle + 1
    else high = middle
  }
  const [x1, y1] = [xs[low] ?? 0, ys[low] ?? 0]
  if (low === 0 || x >= x1) return y1
  const [x0, y0] = [xs[low - 1] ?? 0, ys[low - 1] ?? 0]
  return y0 + ((x - x0) / (x1 - x0)) * (y1 - y0)
}

const M_PER_KM = 1000

/** Round places of a window on an axis, about `count` of them, each with its text. */
export function axisTicks(axis: TraceAxis, low: number, high: number, count: number, units: Units) {
  if (axis.kind !== 'distance') return timeTicks(low, high, count)
  const km = units.show(1, 'km')
  const step = niceStep(((high - low) / M_PER_KM / count) * km)
  const digits = Math.max(0, Math.ceil(-Math.log10(step) - 1e-9))
  const at: number[] = []
  const text: string[] = []
  const last = (high / M_PER_KM) * km + 1e-9
  for (let i = Math.ceil((low / M_PER_KM) * km / step - 1e-9); i * step <= last; i++) {
    at.push(((i * step) / km) * M_PER_KM)
    text.push(`${(i * step).toFixed(digits)} ${units.label('km')}`)
  }
  return { at, text }
}

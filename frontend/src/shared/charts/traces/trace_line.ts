// Traces of a ride: rows of channels, time marks, and bins as points of a line.
import { clock } from '$shared/i18n/locale.svelte'
import type { MarkedEvent } from './event_marks'
import { niceStep } from '$shared/charts/plot_axis'
import type { TraceWindow } from './trace_window.svelte'

/** Room for the marks of events and their title above the first row, in pixels. */
export const MARKS_PX = 40

export interface TraceLine {
  channel: string
  token: string
  /** Its name beside the others of its row, where it is not the channel's. */
  name?: string
  /** Distinguishes it by more than its colour. */
  style?: 'broad' | 'dashed'
}

export interface TraceRow {
  key: string
  unit: string
  lines: TraceLine[]
}

export interface Span {
  from_s: number
  to_s: number
}

export interface Cursor {
  /** Null while there is no cursor. */
  t_s: number | null
  move: (t_s: number) => void
}

/** What is drawn of a ride. */
export interface Traced {
  view: TraceWindow
  rows: TraceRow[]
  gaps?: Span[]
  /** Stretches that came from the unit's own log, coarser than the rest. */
  filled?: Span[]
  events?: MarkedEvent[]
  /** Stretches in which something limited the motor. */
  cuts?: Span[]
  /** What the cursor reads, beside the title of each row. */
  readings?: string[]
  /** The cursor's moment: keys and a press on the plot move it. */
  cursor?: Cursor
  summary: string
  /** What a place of the axis is called, where it is no moment of a ride. */
  place?: (x: number, step?: number) => string
  /** Buttons that zoom and move, where the page has none of its own. */
  tools?: boolean
}

/** Bins as a line that touches the least and the greatest value of each. NaN breaks the line. */
export function binLine(
  first_s: Float64Array,
  last_s: Float64Array,
  min: Float64Array,
  max: Float64Array,
): { x: Float64Array; y: Float64Array } {
  if (min === max) return { x: first_s, y: min }
  const x = new Float64Array(2 * min.length)
  const y = new Float64Array(2 * min.length)
  for (let i = 0; i < min.length; i++) {
    x[2 * i] = first_s[i] ?? NaN
    x[2 * i + 1] = last_s[i] ?? NaN
    y[2 * i] = min[i] ?? NaN
    y[2 * i + 1] = max[i] ?? NaN
  }
  return { x, y }
}

const STEPS_S = [1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200, 14400, 28800]

/** About `count` round moments in a window, with their texts. */
export function timeTicks(
  from_s: number,
  to_s: number,
  count: number,
): { at: number[]; text: string[] } {
  const rough = (to_s - from_s) / count
  const step = rough < 0.7 ? niceStep(rough) : (STEPS_S.find((s) => s >= rough) ?? niceStep(rough))
  const at: number[] = []
  for (let i = Math.ceil(from_s / step - 1e-9); i * step <= to_s + 1e-9; i++) at.push(i * step)
  return { at, text: at.map((t) => moment(t, step)) }
}

/** A moment of the ride, with decimals where whole seconds would repeat. */
export function moment(t_s: number, step_s = 1): string {
  if (step_s >= 1) return clock(t_s)
  const digits = Math.ceil(-Math.log10(step_s))
  const shown = t_s.toFixed(digits)
  return `${clock(Math.floor(Number(shown) + 1e-9))}${shown.slice(shown.indexOf('.'))}`
}

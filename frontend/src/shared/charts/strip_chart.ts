// Live strips: the interface the pages know, so that the chart engine behind it can change.
import type { Column } from '../stream/trace_buffer'

export interface StripLine {
  channel: string
  label: string
  colour: string
  width?: number
}

/** A stretch of time that is drawn shaded, with its name where there is room. */
export interface StripShade {
  from_s: number
  /** Infinity while it goes on. */
  to_s: number
  name: string
}

export interface StripSpec {
  lines: StripLine[]
  /** What the axis shows at least; it grows with the data. */
  least: [number, number]
  span_s: number
  grid: string
  ink: string
  /** What lies under a shade, its edge and its name. */
  shade: [string, string]
  /** The cursor's value: its ground and its text. */
  cursor: [string, string]
}

/** What lies over the lines and under them; times as of the rows. */
export interface StripMarks {
  shades: readonly StripShade[]
  /** Null for no cursor. */
  cursor: { at_s: number; values: (number | null)[] } | null
}

export interface StripChart {
  /** Draws the columns with the right edge at `edge_s`. */
  draw(times: number[], columns: (Column | null)[], edge_s: number, marks: StripMarks): void
  /** Seconds before the right edge of a place in the node, in pixels from its left. */
  secondsAt(x: number): number
  resize(width: number, height: number): void
  destroy(): void
}

/** `least`, or where the data leaves it a range that holds them and ends on round numbers. */
export function roundRange(
  min: number | null,
  max: number | null,
  least: [number, number],
): [number, number] {
  // A sensor's noise about zero must not make the axis jump.
  const slack = 0.03 * (least[1] - least[0])
  const within = (min ?? least[0]) >= least[0] - slack && (max ?? least[1]) <= least[1] + slack
  if (within) return least
  const low = Math.min(least[0], min ?? least[0])
  const high = Math.max(least[1], max ?? least[1])
  const step = niceStep((high - low) / 4)
  return [Math.floor(low / step + 1e-9) * step, Math.ceil(high / step - 1e-9) * step]
}

/** 1, 2 or 5 times a power of ten, at least `rough`. */
export function niceStep(rough: number): number {
  const power = 10 ** Math.floor(Math.log10(rough))
  const factor = [1, 2, 5, 10].find((f) => f * power >= rough - 1e-12) ?? 10
  return factor * power
}

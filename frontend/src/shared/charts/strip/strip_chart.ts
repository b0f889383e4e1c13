// Live strips: the interface the pages know, so that the chart engine behind it can change.
import type { Column } from '$shared/stream/trace_buffer'

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

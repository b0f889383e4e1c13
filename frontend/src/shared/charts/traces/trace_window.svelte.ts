// A window of time over traces: moved, zoomed, and clamped to the ride.
import type { Series } from '$shared/api/series'
import { timeAxis, type TraceAxis } from './trace_axis'

export interface TimeWindow {
  from_s: number
  to_s: number
}

const WINDOW_S_MIN = 0.2

/** A window over a series that is wholly here. */
export class TraceWindow {
  window: TimeWindow = $state.raw({ from_s: 0, to_s: 1 })
  series = $state.raw<Series | null>(null)
  /** What lies across; the window is one of time on every axis. */
  axis = $state.raw<TraceAxis>(timeAxis)

  constructor(
    readonly duration_s: number,
    window: TimeWindow | null = null,
  ) {
    this.window = this.inside(window ?? { from_s: 0, to_s: duration_s })
  }

  get is_complete(): boolean {
    return this.window.from_s <= 0 && this.window.to_s >= this.duration_s
  }

  /** Shows another window. px: width of the plot. */
  show(window: TimeWindow, px: number): void {
    this.window = this.inside(window)
    this.fetchSoon(px)
  }

  showAll(px: number): void {
    this.show({ from_s: 0, to_s: this.duration_s }, px)
  }

  /** The window on the axis. */
  get span(): { low: number; high: number } {
    return { low: this.axis.at(this.window.from_s), high: this.axis.at(this.window.to_s) }
  }

  /** Shows what lies between two places of the axis. */
  showSpan(low: number, high: number, px: number): void {
    const { axis } = this
    if (low <= 0 && high >= axis.at(this.duration_s)) return this.showAll(px)
    this.show({ from_s: axis.moment(Math.max(0, low)), to_s: axis.moment(high) }, px)
  }

  /** Scales the window about its middle: 0.5 zooms in, 2 zooms out. */
  zoom(factor: number, px: number): void {
    const { low, high } = this.span
    const [middle, half] = [(low + high) / 2, ((high - low) / 2) * factor]
    this.showSpan(middle - half, middle + half, px)
  }

  /** Moves the window by a share of its width. */
  pan(share: number, px: number): void {
    const { low, high } = this.span
    const width = high - low
    const most = this.axis.at(this.duration_s) - width
    const begin = Math.min(Math.max(0, low + share * width), most)
    this.showSpan(begin, begin + width, px)
  }

  /** Fetches what the window shows, where it is not here. */
  fetchSoon(px: number): void {
    void px
  }

  private inside(window: TimeWindow): TimeWindow {
    const from_s = Math.max(0, Math.min(window.from_s, this.duration_s - WINDOW_S_MIN))
    const to_s = Math.min(this.duration_s, Math.max(window.to_s, from_s + WINDOW_S_MIN))
    return { from_s, to_s }
  }
}

// A window of time over traces: moved, zoomed, and kept inside the ride.
import type { Series } from '../api/series'

export interface TimeWindow {
  from_s: number
  to_s: number
}

const WINDOW_S_MIN = 0.2

/** A window over a series that is wholly here. */
export class TraceWindow {
  window: TimeWindow = $state.raw({ from_s: 0, to_s: 1 })
  series = $state.raw<Series | null>(null)

  constructor(
    readonly duration_s: number,
    window: TimeWindow | null = null,
  ) {
    this.window = this.inside(window ?? { from_s: 0, to_s: duration_s })
  }

  get whole(): boolean {
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

  /** Scales the window about its middle: 0.5 zooms in, 2 zooms out. */
  zoom(factor: number, px: number): void {
    const middle = (this.window.from_s + this.window.to_s) / 2
    const half = ((this.window.to_s - this.window.from_s) / 2) * factor
    this.show({ from_s: middle - half, to_s: middle + half }, px)
  }

  /** Moves the window by a share of its width. */
  pan(share: number, px: number): void {
    const width = this.window.to_s - this.window.from_s
    const from_s = Math.min(
      Math.max(0, this.window.from_s + share * width),
      this.duration_s - width,
    )
    this.show({ from_s, to_s: from_s + width }, px)
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

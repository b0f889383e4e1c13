// The window of a ride on screen and the series that fills it: the newest window wins, and the old
// curve stays until the new one is there.
import { Refusal } from '../api/client'
import type { Server } from '../api/server'
import { timeAxis, type LaidAxis, type TraceAxis } from './trace_axis'
import { TraceWindow, type TimeWindow } from './trace_window.svelte'

const PACE_MS = 60 // a drag asks this often at most

export class RideView extends TraceWindow {
  loading = $state(false)
  trouble = $state<string | null>(null)
  /** Width of the plot it was asked for last. */
  px = 1000
  private asked = new AbortController()
  private fetched_ms = -Infinity
  private wanted: TraceAxis | LaidAxis = timeAxis
  private timer: ReturnType<typeof setTimeout> | null = null

  constructor(
    private readonly server: Server,
    private readonly ride_id: number,
    public channels: string[],
    duration_s: number,
    window: TimeWindow | null,
  ) {
    super(duration_s, window)
  }

  /** Fetches the window: at once, or with the last of a quick row of them. */
  override fetchSoon(px: number): void {
    this.px = px
    if (this.timer) clearTimeout(this.timer)
    const wait_ms = this.fetched_ms + PACE_MS - performance.now()
    if (wait_ms <= 0) void this.fetch(px)
    else this.timer = setTimeout(() => void this.fetch(px), wait_ms)
  }

  /** Draws over another axis as soon as its curve is there. */
  lay(axis: TraceAxis, px: number): void {
    this.wanted = axis
    this.fetchSoon(px)
  }

  /** Shows other channels; the old curves stay until the new ones are there. */
  choose(channels: string[], px: number): void {
    this.channels = channels
    this.fetchSoon(px)
  }

  stop(): void {
    if (this.timer) clearTimeout(this.timer)
    this.asked.abort()
  }

  private async fetch(px: number): Promise<void> {
    this.fetched_ms = performance.now()
    this.asked.abort()
    this.asked = new AbortController()
    const { signal } = this.asked
    this.loading = true
    // Whole hundreds of pixels: the same window on almost the same screen is the same request.
    const axis = this.wanted
    const wanted = { px: Math.max(100, Math.round(px / 100) * 100), axis: axis.kind }
    const query = this.whole ? wanted : { ...wanted, ...this.window }
    try {
      const series = await this.server.series(this.ride_id, this.channels, query, signal)
      if (signal.aborted) return
      this.series = series
      this.axis = 'refined' in axis ? axis.refined(series) : axis
      this.trouble = null
    } catch (error) {
      if (signal.aborted) return
      if (!(error instanceof Refusal)) throw error
      this.trouble = error.message
    }
    this.loading = false
  }
}

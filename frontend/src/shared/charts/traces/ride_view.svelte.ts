// The window of a ride on screen and the series that fills it: the newest window wins, and the old
// curve stays until the new one is there.
import { Refusal } from '$shared/api/client'
import type { Series } from '$shared/api/series'
import type { Server } from '$shared/api/server'
import { Pace } from '$shared/context/pace'
import { timeAxis, type LaidAxis, type TraceAxis } from './trace_axis'
import { TraceWindow, type TimeWindow } from './trace_window.svelte'

const PACE_MS = 60 // a drag sends requests at most this often

/** Fetches the series of a window; without ends, of the complete ride. */
export type FetchSeries = (
  channels: string[],
  query: { px: number; axis: Series['axis']; from_s?: number; to_s?: number },
  signal: AbortSignal,
) => Promise<Series>

export function ofRide(server: Server, id: number): FetchSeries {
  return (channels, query, signal) => server.series(id, channels, query, signal)
}

export class RideView extends TraceWindow {
  channels = $state.raw<string[]>([])
  loading = $state(false)
  problem = $state<string | null>(null)
  /** Width of the plot of the last request. */
  px = 1000
  private controller = new AbortController()
  private readonly pace = new Pace(PACE_MS)

  constructor(
    readonly fetchSeries: FetchSeries,
    channels: string[],
    duration_s: number,
    window: TimeWindow | null,
    private requested_axis: TraceAxis | LaidAxis = timeAxis,
  ) {
    super(duration_s, window)
    this.axis = requested_axis
    this.channels = channels
  }

  /** Fetches the window: at once, or with the last of a quick row of them. */
  override fetchSoon(px: number): void {
    this.px = px
    this.pace.soon(() => void this.fetch(px))
  }

  /** Draws over another axis as soon as its curve is there. */
  lay(axis: TraceAxis, px: number): void {
    this.requested_axis = axis
    this.fetchSoon(px)
  }

  /** Shows other channels; the old curves stay until the new ones are there. */
  choose(channels: string[], px: number): void {
    this.channels = channels
    this.fetchSoon(px)
  }

  stop(): void {
    this.pace.stop()
    this.controller.abort()
  }

  private async fetch(px: number): Promise<void> {
    this.controller.abort()
    this.controller = new AbortController()
    const { signal } = this.controller
    this.loading = true
    // Whole hundreds of pixels: the same window on almost the same screen is the same request.
    const axis = this.requested_axis
    const bins = { px: Math.max(100, Math.round(px / 100) * 100), axis: axis.kind }
    const query = this.is_complete ? bins : { ...bins, ...this.window }
    try {
      const series = await this.fetchSeries(this.channels, query, signal)
      if (signal.aborted) return
      this.series = series
      this.axis = 'refined' in axis ? axis.refined(series) : axis
      this.problem = null
    } catch (error) {
      if (signal.aborted) return
      if (!(error instanceof Refusal)) throw error
      this.problem = error.message
    }
    this.loading = false
  }
}

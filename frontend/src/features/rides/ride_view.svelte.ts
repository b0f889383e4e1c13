// The window of a ride on screen and the series that fills it: the newest window wins, and the old
// curve stays until the new one is there.
import { Refusal } from '$shared/api/client'
import type { Series } from '$shared/api/series'
import type { Server } from '$shared/api/server'

export interface TimeWindow {
  from_s: number
  to_s: number
}

const PACE_MS = 60 // a drag asks this often at most
const WINDOW_S_MIN = 0.2

export class RideView {
  window: TimeWindow = $state.raw({ from_s: 0, to_s: 1 })
  series = $state.raw<Series | null>(null)
  loading = $state(false)
  trouble = $state<string | null>(null)
  private asked = new AbortController()
  private fetched_ms = -Infinity
  private timer: ReturnType<typeof setTimeout> | null = null

  constructor(
    private readonly server: Server,
    private readonly ride_id: number,
    readonly channels: string[],
    private readonly duration_s: number,
    window: TimeWindow | null,
  ) {
    this.window = this.inside(window ?? { from_s: 0, to_s: duration_s })
  }

  get whole(): boolean {
    return this.window.from_s <= 0 && this.window.to_s >= this.duration_s
  }

  /** Shows another window and fetches it: at once, or with the last of a quick row of them. */
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

  fetchSoon(px: number): void {
    if (this.timer) clearTimeout(this.timer)
    const wait_ms = this.fetched_ms + PACE_MS - performance.now()
    if (wait_ms <= 0) void this.fetch(px)
    else this.timer = setTimeout(() => void this.fetch(px), wait_ms)
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
    const wanted = { px: Math.max(100, Math.round(px / 100) * 100) }
    const query = this.whole ? wanted : { ...wanted, ...this.window }
    try {
      const series = await this.server.series(this.ride_id, this.channels, query, signal)
      if (signal.aborted) return
      this.series = series
      this.trouble = null
    } catch (error) {
      if (signal.aborted) return
      if (!(error instanceof Refusal)) throw error
      this.trouble = error.message
    }
    this.loading = false
  }

  private inside(window: TimeWindow): TimeWindow {
    const from_s = Math.max(0, Math.min(window.from_s, this.duration_s - WINDOW_S_MIN))
    const to_s = Math.min(this.duration_s, Math.max(window.to_s, from_s + WINDOW_S_MIN))
    return { from_s, to_s }
  }
}

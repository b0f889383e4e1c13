// The value of every channel of a ride at the cursor: the row that holds there, as recorded.
import type { Server } from '$shared/api/server'
import type { Ride } from '$shared/api/types'
import { Pace } from '$shared/context/pace'

const PACE_MS = 40 // a drag sends requests at most this often
// A head unit's row holds until the next one; a longer silence is a gap.
const ROW_S_MAX = 10

export class CursorReading {
  /** By channel; null where there is none. All of it is null until the first answer. */
  values = $state.raw<Record<string, number | null> | null>(null)
  private readonly left = new AbortController()
  private readonly pace = new Pace(PACE_MS)

  constructor(
    private readonly server: Server,
    private readonly ride: Ride,
  ) {}

  at(t_s: number): void {
    this.pace.soon(() => this.fetch(t_s))
  }

  stop(): void {
    this.pace.stop()
    this.left.abort()
  }

  private async fetch(t_s: number): Promise<void> {
    const { signal } = this.left
    const { channels, period_us } = this.ride
    const row_s = period_us === null ? ROW_S_MAX : period_us / 1e6
    const window = { from_s: Math.max(0, t_s - row_s + 1e-6), to_s: t_s, px: 2000 }
    const names = channels.map(({ name }) => name)
    try {
      const series = await this.server.series(this.ride.id, names, window, signal)
      if (signal.aborted) return
      const row = series.t_first_s.length - 1
      const values = series.channels.map(({ name, min }) => {
        const value = min[row] ?? NaN
        return [name, Number.isNaN(value) ? null : value] as const
      })
      this.values = Object.fromEntries(values)
    } catch {
      if (!signal.aborted) this.values = null // the traces say what is wrong
    }
  }
}

// What the strips show: the stream as it comes, or while they are paused what came before, and a
// cursor in it.
import type { LiveStream } from '$shared/stream/live.svelte'
import type { Column } from '$shared/stream/trace_buffer'
import { MADE_OF } from './figures'

interface Rows {
  times: number[]
  columns: Column[]
}

export const SPAN_S = 30

export class StripView {
  /** The rows that were there when the strips were paused; null while they move. */
  private frozen = $state.raw<Rows | null>(null)
  /** Seconds before the right edge, 0 or less; null for none. */
  cursor_s = $state<number | null>(null)

  constructor(private readonly stream: LiveStream) {}

  get paused(): boolean {
    return this.frozen !== null
  }

  private get rows(): Rows {
    return this.frozen ?? this.stream.buffer
  }

  get times(): number[] {
    return this.rows.times
  }

  /** Stands still, or goes on. */
  toggle(): void {
    this.cursor_s = null
    const { times, columns } = this.stream.buffer
    const copy = () => ({ times: times.slice(), columns: columns.map((one) => one.slice()) })
    this.frozen = this.frozen ? null : copy()
  }

  /** Moves the cursor, from the right edge where there is none; only while paused. */
  move(by_s: number): void {
    if (this.paused) this.put((this.cursor_s ?? 0) + by_s)
  }

  put(at_s: number): void {
    if (this.paused) this.cursor_s = Math.min(0, Math.max(-SPAN_S, at_s))
  }

  /** A channel's values; null where the reading it is made of was missing. */
  column(channel: string): Column | null {
    const column = this.rows.columns[this.stream.column(channel)] ?? null
    const source = MADE_OF[channel]
    const made_of = source && this.rows.columns[this.stream.column(source)]
    if (!column || !made_of) return column
    return column.map((value, row) => (made_of[row] === null ? null : value))
  }
}

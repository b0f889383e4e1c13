// The last seconds of a stream, column by column, as the strip charts draw them.
import { valueOf, type StreamFrame, type StreamHeader } from './frame'

export type Column = (number | null)[]

/** Keeps `window_s` of unit time; lost rows leave one empty row, so that a line breaks there. */
export class TraceBuffer {
  times: number[] = []
  columns: Column[] = []
  private scales: number[] = []
  private period_s = 0.01

  constructor(private readonly window_s: number) {}

  /** Starts over with these channels. */
  reset(header: StreamHeader): void {
    this.times = []
    this.columns = header.channels.map(() => [])
    this.scales = header.channels.map((channel) => channel.scale)
    this.period_s = header.period_us / 1e6
  }

  /** Adds a frame; time that runs backwards (the unit restarted) empties the buffer first. */
  append(frame: StreamFrame): void {
    if (frame.channels !== this.columns.length) return
    if (frame.t0_s < this.end_s) this.clear()
    if (frame.lost_rows > 0 && this.times.length > 0) this.addBreak(frame.t0_s - this.period_s)
    for (let row = 0; row < frame.rows; row++) {
      this.times.push(frame.t0_s + row * this.period_s)
      for (let c = 0; c < frame.channels; c++) {
        const count = frame.counts[row * frame.channels + c]
        this.columns[c]?.push(valueOf(count, this.scales[c] ?? 1))
      }
    }
    this.trim()
  }

  /** Time of the newest row in seconds of unit time; -Infinity while empty. */
  get end_s(): number {
    return this.times[this.times.length - 1] ?? -Infinity
  }

  private addBreak(at_s: number): void {
    this.times.push(at_s)
    for (const column of this.columns) column.push(null)
  }

  private clear(): void {
    this.times = []
    this.columns = this.columns.map(() => [])
  }

  // Dropping rows one by one would move the whole array each time: wait for a fifth too many.
  private trim(): void {
    const oldest_s = this.end_s - this.window_s
    if ((this.times[0] ?? Infinity) > oldest_s - 0.2 * this.window_s) return
    const first = this.times.findIndex((t) => t >= oldest_s)
    this.times.splice(0, first)
    for (const column of this.columns) column.splice(0, first)
  }
}

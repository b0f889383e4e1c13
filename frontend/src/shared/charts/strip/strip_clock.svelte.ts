// The right edge of the strips: follows the newest row, and moves on smoothly between frames.

const FOLLOW_MS = 120 // how far the edge may run behind the newest row to hide uneven arrival
const RATE_OVER_MS = 1000

export class StripClock {
  edge_s = 0
  frame = $state(-1)
  fps = $state(0)
  private running = false
  private last_ms = 0
  private rate = 1 // unit seconds per second; a simulated unit may run faster
  private anchor = { ms: 0, end_s: -Infinity }
  private drawn: number[] = []

  /** Calls for a drawing on every animation frame until `stop`. `end_s`: the newest row's time. */
  start(end_s: () => number, isFrozen: () => boolean): void {
    this.running = true
    const step = (now_ms: number) => {
      if (!this.running) return
      const end = end_s()
      if (!isFrozen() && Number.isFinite(end)) this.advance(now_ms, end)
      requestAnimationFrame(step)
    }
    requestAnimationFrame(step)
  }

  stop(): void {
    this.running = false
  }

  /** Moves the edge to where it belongs at `now_ms` and counts the frame, if anything moved. */
  advance(now_ms: number, end_s: number): void {
    const elapsed_s = Math.min(0.25, (now_ms - this.last_ms) / 1000)
    this.last_ms = now_ms
    this.measureRate(now_ms, end_s)
    const behind_s = (FOLLOW_MS / 1000) * Math.max(1, this.rate)
    const next = Math.max(this.edge_s + elapsed_s * Math.max(0.1, this.rate), end_s - behind_s)
    const edge = end_s < this.edge_s - 1 ? end_s : Math.min(next, end_s)
    if (edge === this.edge_s) return
    this.edge_s = edge
    this.frame += 1
    this.count(now_ms)
  }

  private measureRate(now_ms: number, end_s: number): void {
    const elapsed_ms = now_ms - this.anchor.ms
    if (elapsed_ms < RATE_OVER_MS) return
    const rate = ((end_s - this.anchor.end_s) * 1000) / elapsed_ms
    if (Number.isFinite(rate) && elapsed_ms < 3 * RATE_OVER_MS) {
      this.rate = Math.min(1000, Math.max(0, rate))
    }
    this.anchor = { ms: now_ms, end_s }
  }

  private count(now_ms: number): void {
    this.drawn.push(now_ms)
    while ((this.drawn[0] ?? now_ms) < now_ms - 1000) this.drawn.shift()
    if (this.frame % 15 === 0) this.fps = this.drawn.length
  }
}

// Work that is requested more often than it may be done: the first at once, then the newest only,
// one at a time and at most once in a period.
type Work = () => Promise<void> | void

export class Pace {
  private newest: Work | null = null
  private timer: ReturnType<typeof setTimeout> | null = null
  private busy = false
  private began_ms = -Infinity

  constructor(private readonly period_ms: number) {}

  /** Does the work, or with the last of a quick row the newest of it. */
  soon(work: Work): void {
    this.newest = work
    this.turn()
  }

  /** Forgets what waits. */
  stop(): void {
    this.newest = null
    if (this.timer) clearTimeout(this.timer)
    this.timer = null
  }

  private turn(): void {
    if (this.busy || this.timer || !this.newest) return
    const wait_ms = this.began_ms + this.period_ms - performance.now()
    if (wait_ms > 0) {
      this.timer = setTimeout(() => {
        this.timer = null
        this.turn()
      }, wait_ms)
      return
    }
    const work = this.newest
    this.newest = null
    this.began_ms = performance.now()
    const done = work()
    if (!done) return
    this.busy = true
    void done.finally(() => {
      this.busy = false
      this.turn()
    })
  }
}

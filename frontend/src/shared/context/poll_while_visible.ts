// Polls while the page is visible, and at once when it becomes visible again.
export class PollWhileVisible {
  private timer: ReturnType<typeof setTimeout> | null = null
  private stopped = false

  constructor(
    private readonly work: () => Promise<void>,
    private readonly period_ms: number,
  ) {}

  start(): void {
    document.addEventListener('visibilitychange', this.wake)
    window.addEventListener('online', this.wake)
    void this.turn()
  }

  stop(): void {
    this.stopped = true
    if (this.timer) clearTimeout(this.timer)
    document.removeEventListener('visibilitychange', this.wake)
    window.removeEventListener('online', this.wake)
  }

  private readonly wake = (): void => {
    if (!document.hidden) void this.turn()
  }

  private async turn(): Promise<void> {
    if (this.timer) clearTimeout(this.timer)
    if (!document.hidden) await this.work()
    if (!this.stopped) this.timer = setTimeout(() => void this.turn(), this.period_ms)
  }
}

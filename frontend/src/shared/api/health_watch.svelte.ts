// Whether everything that is to be kept is kept, asked every few seconds while the page is seen.
import { Refusal } from './client'
import type { Server } from './server'
import type { Health, RecorderHealth } from './types'

const PERIOD_MS = 5000

export class HealthWatch {
  /** The server's last word; null until it came, and while the server does not answer. */
  now = $state.raw<Health | null>(null)
  private timer: ReturnType<typeof setTimeout> | null = null
  private stopped = false

  constructor(private readonly server: Server) {}

  start(): void {
    document.addEventListener('visibilitychange', this.wake)
    window.addEventListener('online', this.wake)
    void this.ask()
  }

  stop(): void {
    this.stopped = true
    if (this.timer) clearTimeout(this.timer)
    document.removeEventListener('visibilitychange', this.wake)
    window.removeEventListener('online', this.wake)
  }

  /** What became of a unit's rows since the server started; null while nobody knows. */
  recorder(device_id: string): RecorderHealth | null {
    return this.now?.devices.find((device) => device.id === device_id)?.recorder ?? null
  }

  private readonly wake = (): void => {
    if (!document.hidden) void this.ask()
  }

  private async ask(): Promise<void> {
    if (this.timer) clearTimeout(this.timer)
    if (!document.hidden) await this.refresh()
    if (!this.stopped) this.timer = setTimeout(() => void this.ask(), PERIOD_MS)
  }

  private async refresh(): Promise<void> {
    try {
      this.now = await this.server.health()
    } catch (error) {
      if (!(error instanceof Refusal)) throw error
      this.now = null
    }
  }
}

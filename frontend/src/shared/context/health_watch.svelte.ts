// Whether everything is being stored, polled every few seconds while the page is visible.
import { Refusal } from '../api/client'
import type { Server } from '../api/server'
import type { Health, RecorderHealth } from '../api/types'
import { PollWhileVisible } from './poll_while_visible'

const PERIOD_MS = 5000

export class HealthWatch {
  /** The server's last word; null until it came, and while the server does not answer. */
  now = $state.raw<Health | null>(null)
  private readonly polling = new PollWhileVisible(() => this.refresh(), PERIOD_MS)

  constructor(private readonly server: Server) {}

  start(): void {
    this.polling.start()
  }

  stop(): void {
    this.polling.stop()
  }

  /** What became of a unit's rows since the server started; null while unknown. */
  recorder(device_id: string): RecorderHealth | null {
    return this.now?.devices.find((device) => device.id === device_id)?.recorder ?? null
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

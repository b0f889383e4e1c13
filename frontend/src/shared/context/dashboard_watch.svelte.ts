// What the server sums up of a unit's rows once a second: powers, distance and range.
import { Refusal } from '../api/client'
import type { Server } from '../api/server'
import type { Dashboard } from '../api/types'
import { PollWhileVisible } from './poll_while_visible'

const PERIOD_MS = 1000

export class DashboardWatch {
  /** Null until the first answer and while there is none: nothing old is shown. */
  values = $state.raw<Dashboard | null>(null)
  private readonly polling = new PollWhileVisible(() => this.refresh(), PERIOD_MS)

  constructor(
    private readonly server: Server,
    private readonly device_id: string,
    /** Called after each poll. */
    private readonly onvalues: (values: Dashboard | null) => void = () => undefined,
  ) {}

  start(): void {
    this.polling.start()
  }

  stop(): void {
    this.polling.stop()
  }

  private async refresh(): Promise<void> {
    try {
      this.values = await this.server.dashboard(this.device_id)
    } catch (error) {
      if (!(error instanceof Refusal)) throw error
      this.values = null
    }
    this.onvalues(this.values)
  }
}

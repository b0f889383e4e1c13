// The bikes that the caller may see, polled while the page is visible.
import { BikeServer, type Bike } from '$shared/api/bike_server'
import { Refusal, type Http } from '$shared/api/client'
import { PollWhileVisible } from '$shared/context/poll_while_visible'

const PERIOD_MS = 10_000

export class BikeList {
  /** Null while unknown. */
  items = $state.raw<Bike[] | null>(null)
  refusal = $state.raw<Refusal | null>(null)
  private readonly server: BikeServer

  constructor(http: Http) {
    this.server = new BikeServer(http)
  }

  /** Polls until what comes back is called. */
  watch(): () => void {
    const polling = new PollWhileVisible(() => this.refresh(), PERIOD_MS)
    polling.start()
    return () => polling.stop()
  }

  async refresh(): Promise<void> {
    try {
      this.items = await this.server.list()
      this.refusal = null
    } catch (error) {
      if (!(error instanceof Refusal)) throw error
      this.refusal = error
    }
  }
}

// The newest moment of the ride that a unit is being recorded on, explained again and again.
import type { Refusal } from '$shared/api/client'
import { NewestAnswer } from '$shared/api/newest_answer.svelte'
import type { Server } from '$shared/api/server'
import type { Ride, Why } from '$shared/api/types'

export class LiveMoment {
  /** The ride that goes on; null while none does. */
  ride = $state.raw<Ride | null>(null)
  t_s = $state(0)
  loaded = $state(false)
  private readonly newest = new NewestAnswer<Why>()

  constructor(private readonly server: Server) {}

  get why(): Why | null {
    return this.ride && this.newest.value
  }

  get refused(): Refusal | null {
    return this.newest.refusal
  }

  /** Explains what was recorded last. Waits for one answer before the next request. */
  async refresh(unit_key: string | null): Promise<void> {
    const [newest] = unit_key === null ? [] : await this.server.latestRides(unit_key, 1)
    this.loaded = true
    this.ride = newest?.state === 'live' ? newest : null
    if (!this.ride) return
    const { id, row_count, period_us } = this.ride
    if (!row_count || !period_us) return
    const t_s = ((row_count - 1) * period_us) / 1e6
    await this.newest.request((signal) => this.server.whyOfRide(id, t_s, signal))
    this.t_s = t_s
  }

  stop(): void {
    this.newest.stop()
  }
}

// The rides a table can be tried on, newest first, and the one that the address names.
import { Refusal } from '$shared/api/client'
import type { Server } from '$shared/api/server'
import type { Ride } from '$shared/api/types'
import { canBeTried } from './triable'

export class RidesToTry {
  items = $state.raw<Ride[]>([])
  loaded = $state(false)
  /** Of the next page of rides; null behind the last. */
  next = $state<string | null>(null)
  problem = $state.raw<Refusal | null>(null)

  constructor(private readonly server: Server) {}

  /** Fetches the newest rides, or the next older ones. */
  async load(): Promise<void> {
    await this.fetch(async () => {
      const { items, next } = await this.server.rides(this.next ?? undefined)
      this.add(items.filter(canBeTried))
      this.next = next
      this.loaded = true
    })
  }

  /** Fetches one ride, whether it can be tried or not. */
  async include(ride_id: number): Promise<void> {
    await this.fetch(async () => this.add([await this.server.ride(ride_id)]))
  }

  private add(rides: Ride[]): void {
    const others = this.items.filter((one) => !rides.some((ride) => ride.id === one.id))
    const all = [...others, ...rides]
    this.items = all.sort((a, b) => b.started_at.localeCompare(a.started_at))
  }

  private async fetch(load: () => Promise<void>): Promise<void> {
    try {
      await load()
    } catch (error) {
      if (!(error instanceof Refusal)) throw error
      this.problem = error
    }
  }
}

// A ride and a part of it, chosen by eye; and the rides there are to choose from, newest first.
import { Refusal } from '$shared/api/client'
import type { Server } from '$shared/api/server'
import type { Ride, RideList } from '$shared/api/types'
import { ofRide, RideView } from '$shared/charts/traces/ride_view.svelte'
import type { TraceRow } from '$shared/charts/traces/trace_line'

const ROWS: TraceRow[] = [
  { key: 'speed', unit: 'km/h', lines: [{ channel: 'speed_kmh', token: 'speed' }] },
  { key: 'rider_torque_nm', unit: 'Nm', lines: [{ channel: 'rider_torque_nm', token: 'rider' }] },
  { key: 'altitude', unit: 'm of altitude', lines: [{ channel: 'altitude_m', token: 'battery' }] },
]

export const offers = (ride: Ride, names: readonly string[]) =>
  names.every((name) => ride.channels.some((channel) => channel.name === name))

export class BikeRides {
  items = $state.raw<Ride[]>([])
  loaded = $state(false)
  /** Of the next page of rides; null behind the last. */
  next = $state<string | null>(null)
  problem = $state.raw<Refusal | null>(null)

  constructor(private readonly server: Server) {}

  /** Fetches rides added since; those already listed stay unchanged. */
  refresh = async (): Promise<void> => {
    await this.fetch(undefined, ({ next }) => {
      if (!this.loaded) this.next = next
    })
    this.loaded = true
  }

  /** Fetches the next older ones. */
  async more(): Promise<void> {
    await this.fetch(this.next ?? undefined, ({ next }) => (this.next = next))
  }

  private async fetch(cursor: string | undefined, then: (page: RideList) => void): Promise<void> {
    try {
      const page = await this.server.rides(cursor)
      const existing = this.items.map(({ id }) => id)
      const fresh = page.items.filter(
        ({ id, state, damage }) => !existing.includes(id) && state === 'done' && !damage,
      )
      const newest = (a: Ride, b: Ride) => b.started_at.localeCompare(a.started_at)
      if (fresh.length > 0) this.items = [...this.items, ...fresh].sort(newest)
      this.problem = null
      then(page)
    } catch (error) {
      if (!(error instanceof Refusal)) throw error
      this.problem = error
    }
  }
}

export class RidePart {
  ride = $state.raw<Ride | null>(null)
  view = $state.raw<RideView | null>(null)
  rows = $state.raw<TraceRow[]>([])

  constructor(private readonly server: Server) {}

  choose(ride: Ride | null): void {
    this.stop()
    const end_s = ride?.summary?.duration_s ?? 0
    this.ride = ride
    const names = ({ lines }: TraceRow) => lines.map(({ channel }) => channel)
    // Not read back from `this`: an effect that chooses would then never come to rest.
    const rows = ride ? ROWS.filter((row) => offers(ride, names(row))) : []
    this.rows = rows
    const channels = rows.flatMap(names)
    const drawn = ride !== null && end_s > 0 && channels.length > 0
    this.view = drawn ? new RideView(ofRide(this.server, ride.id), channels, end_s, null) : null
  }

  /** The selected part; without ends, the complete ride. */
  get selection(): { ride_id: number; from_s: number | null; to_s: number | null } | null {
    if (!this.ride) return null
    const { window, is_complete } = this.view ?? { window: null, is_complete: true }
    const ends = is_complete || !window ? { from_s: null, to_s: null } : window
    return { ride_id: this.ride.id, ...ends }
  }

  stop(): void {
    this.view?.stop()
  }
}

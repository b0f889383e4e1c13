// A moment of a ride, and why the motor gave what it gave then.
import { Refusal } from '$shared/api/client'
import { NewestAnswer } from '$shared/api/newest_answer.svelte'
import type { Server } from '$shared/api/server'
import type { Cut, Ride, Why } from '$shared/api/types'

const PACE_MS = 60 // a cursor that is moved sends requests at most this often

export class RideMoment {
  ride = $state.raw<Ride | null>(null)
  cuts = $state.raw<Cut[]>([])
  t_s = $state(0)
  private problem = $state.raw<Refusal | null>(null)
  private readonly newest = new NewestAnswer<Why>()
  private last_ms = -Infinity
  private timer: ReturnType<typeof setTimeout> | null = null

  constructor(private readonly server: Server) {}

  /** Opens a ride at a moment; without one where a limit first acted, else in its middle. */
  async open(ride_id: number | null, t_s: number | null): Promise<void> {
    try {
      const id = ride_id ?? (await this.latest())
      if (id === null) return
      const [ride, cuts] = await Promise.all([this.server.ride(id), this.server.cuts(id)])
      this.ride = ride
      this.problem = null
      if (this.unknown) return
      this.cuts = cuts
      this.move(t_s ?? cuts[0]?.at_s ?? this.end_s / 2)
    } catch (error) {
      if (!(error instanceof Refusal)) throw error
      this.problem = error
    }
  }

  get why(): Why | null {
    return this.newest.value
  }

  get refused(): Refusal | null {
    return this.problem ?? this.newest.refusal
  }

  /** The configuration of the ride is unknown: nothing of it is explained. */
  get unknown(): boolean {
    return this.ride !== null && this.ride.device.config_crc32 === null
  }

  get end_s(): number {
    return this.ride?.summary?.duration_s ?? 0
  }

  /** The cut that the moment lies in; null where no limit acted. */
  get cut(): Cut | null {
    return this.cuts.find(({ from_s, to_s }) => from_s <= this.t_s && this.t_s < to_s) ?? null
  }

  readonly move = (t_s: number): void => {
    this.t_s = Math.max(0, Math.min(t_s, this.end_s))
    if (this.timer) clearTimeout(this.timer)
    const wait_ms = this.last_ms + PACE_MS - performance.now()
    this.timer = setTimeout(() => void this.request(), Math.max(0, wait_ms))
  }

  /** To the next cut, or of the one before. False where there is none. */
  toCut(forwards: boolean): boolean {
    const here = this.cut
    const others = this.cuts.filter((cut) => cut !== here)
    const cut = forwards
      ? others.find(({ from_s }) => from_s > this.t_s)
      : others.findLast(({ to_s }) => to_s <= this.t_s)
    if (cut) this.move(cut.at_s)
    return cut !== undefined
  }

  stop(): void {
    if (this.timer) clearTimeout(this.timer)
    this.newest.stop()
  }

  private async latest(): Promise<number | null> {
    const { items } = await this.server.rides()
    const explainable = items.filter(({ state, device }) => state === 'done' && device.config_crc32)
    return explainable[0]?.id ?? null
  }

  private async request(): Promise<void> {
    if (!this.ride) return
    this.last_ms = performance.now()
    const [id, t_s] = [this.ride.id, this.t_s]
    await this.newest.request((signal) => this.server.whyOfRide(id, t_s, signal))
  }
}

// A state that the user sets.
import type { Refusal } from '$shared/api/client'
import { NewestAnswer } from '$shared/api/newest_answer.svelte'
import type { Server } from '$shared/api/server'
import type { Why, WhyRequest } from '$shared/api/types'

const PACE_MS = 60 // a slider that is dragged sends requests at most this often

export class SteadyState {
  private readonly newest = new NewestAnswer<Why>()
  private timer: ReturnType<typeof setTimeout> | null = null

  constructor(private readonly server: Server) {}

  /** device_id: whose configuration; null for the firmware's. */
  request(device_id: string | null, state: WhyRequest): void {
    if (this.timer) clearTimeout(this.timer)
    this.timer = setTimeout(
      () => void this.newest.request((signal) => this.server.whySteady(device_id, state, signal)),
      PACE_MS,
    )
  }

  get why(): Why | null {
    return this.newest.value
  }

  get refused(): Refusal | null {
    return this.newest.refusal
  }

  stop(): void {
    if (this.timer) clearTimeout(this.timer)
    this.newest.stop()
  }
}

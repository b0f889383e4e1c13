// A state that somebody asks about: the newest question wins, and the old answer stays until then.
import { Refusal } from '$shared/api/client'
import type { Server } from '$shared/api/server'
import type { Why, WhyRequest } from '$shared/api/types'

const PACE_MS = 60 // a slider that is dragged asks this often at most

export class SteadyState {
  why = $state.raw<Why | null>(null)
  refused = $state.raw<Refusal | null>(null)
  private asked = new AbortController()
  private timer: ReturnType<typeof setTimeout> | null = null

  constructor(private readonly server: Server) {}

  /** device_id: whose configuration; null for the firmware's. */
  ask(device_id: string | null, state: WhyRequest): void {
    if (this.timer) clearTimeout(this.timer)
    this.timer = setTimeout(() => void this.fetch(device_id, state), PACE_MS)
  }

  stop(): void {
    if (this.timer) clearTimeout(this.timer)
    this.asked.abort()
  }

  private async fetch(device_id: string | null, state: WhyRequest): Promise<void> {
    this.asked.abort()
    this.asked = new AbortController()
    const { signal } = this.asked
    try {
      const why = await this.server.whySteady(device_id, state, signal)
      if (signal.aborted) return
      this.why = why
      this.refused = null
    } catch (error) {
      if (signal.aborted) return
      if (!(error instanceof Refusal)) throw error
      this.refused = error
      this.why = null
    }
  }
}

// How strongly each rule fires where the bike is now, by the unit's own law on the server.
import { NewestAnswer } from '$shared/api/newest_answer.svelte'
import type { Server } from '$shared/api/server'
import type { Why, WhyRequest } from '$shared/api/types'

const PACE_MS = 200 // an eye follows no more

export class Firing {
  private readonly newest = new NewestAnswer<Why>()
  private last_ms = -Infinity
  private timer: ReturnType<typeof setTimeout> | undefined

  constructor(private readonly server: Server) {}

  /** Weight of a rule, 0 to 1. */
  weight(row: number, column: number): number {
    const rule = this.newest.value?.rules.find((one) => one.row === row && one.column === column)
    return rule?.weight ?? 0
  }

  /** The place that the bike is at, with the tables as edited; null where unknown. */
  request(state: WhyRequest | null): void {
    clearTimeout(this.timer)
    if (!state) {
      this.newest.forget()
      return
    }
    this.timer = setTimeout(() => {
      this.last_ms = performance.now()
      void this.newest.request((signal) => this.server.whySteady(null, state, signal))
    }, this.last_ms + PACE_MS - performance.now())
  }

  stop(): void {
    clearTimeout(this.timer)
    this.newest.stop()
  }
}

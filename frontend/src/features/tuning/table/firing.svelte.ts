// How strongly each rule fires where the bike is now, by the unit's own law on the server.
import { NewestAnswer } from '$shared/api/newest_answer.svelte'
import type { Server } from '$shared/api/server'
import type { Why, WhyRequest } from '$shared/api/types'

const PACE_MS = 200 // an eye follows no more

export class Firing {
  private readonly newest = new NewestAnswer<Why>()
  private asked_ms = -Infinity
  private timer: ReturnType<typeof setTimeout> | null = null

  constructor(private readonly server: Server) {}

  /** Weight of a rule, 0 to 1. */
  weight(row: number, column: number): number {
    const rule = this.newest.value?.rules.find((one) => one.row === row && one.column === column)
    return rule?.weight ?? 0
  }

  /** The place that the bike is at, with the tables as edited; null where nobody knows. */
  ask(state: WhyRequest | null): void {
    if (this.timer) clearTimeout(this.timer)
    if (!state) {
      this.newest.stop()
      this.newest.value = null
      return
    }
    const wait_ms = this.asked_ms + PACE_MS - performance.now()
    this.timer = setTimeout(() => {
      this.asked_ms = performance.now()
      void this.newest.request((signal) => this.server.whySteady(null, state, signal))
    }, Math.max(0, wait_ms))
  }

  stop(): void {
    if (this.timer) clearTimeout(this.timer)
    this.newest.stop()
  }
}

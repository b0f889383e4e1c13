// The comparison that is shown: of the newest question only.
import { Refusal } from '$shared/api/client'
import type { Server } from '$shared/api/server'
import type { ComparedSide, Comparison } from '$shared/api/types'

export class ComparisonRun {
  answer = $state.raw<Comparison | null>(null)
  refused = $state.raw<Refusal | null>(null)
  private asking: AbortController | null = null

  constructor(private readonly server: Server) {}

  /** Asks; an earlier question that is still open is given up. */
  async ask(left: ComparedSide, right: ComparedSide): Promise<void> {
    this.stop()
    const asking = new AbortController()
    this.asking = asking
    try {
      const answer = await this.server.compare(left, right, asking.signal)
      if (this.asking === asking) [this.answer, this.refused] = [answer, null]
    } catch (error) {
      if (this.asking !== asking || !(error instanceof Refusal)) return
      ;[this.answer, this.refused] = [null, error]
    }
  }

  stop(): void {
    this.asking?.abort()
    this.asking = null
  }
}

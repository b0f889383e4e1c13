// What the modes give for a steady push, from the unit's own law on the server. The newest question
// wins: an answer to an older one is dropped.
import { Refusal } from '$shared/api/client'
import type { Server } from '$shared/api/server'
import type { ModeCurves, ParameterValue } from '$shared/api/types'

export const PUSH_NM = 30
export const SPEEDS_KMH = Array.from({ length: 28 }, (_, i) => i + 1)

export class CurvesQuestion {
  /** Null until the first answer, and while the modes as edited cannot be worked out. */
  found = $state.raw<ModeCurves | null>(null)
  private asked = new AbortController()

  constructor(private readonly server: Server) {}

  async ask(parameters: Record<string, ParameterValue>): Promise<void> {
    this.asked.abort()
    this.asked = new AbortController()
    const { signal } = this.asked
    try {
      const found = await this.server.modeCurves(parameters, PUSH_NM, SPEEDS_KMH, signal)
      if (!signal.aborted) this.found = found
    } catch (error) {
      if (signal.aborted) return
      if (!(error instanceof Refusal)) throw error
      this.found = null
    }
  }

  stop(): void {
    this.asked.abort()
  }
}

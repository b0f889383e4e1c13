// The surface and the findings of a table as it is edited, from the unit's own law on the server.
// The newest table wins: an answer to an older one is dropped.
import { Refusal } from '$shared/api/client'
import type { Server } from '$shared/api/server'
import type { LintReport, LintRequest } from '$shared/api/types'
import { spread } from './table'

const POINTS = 41

export interface Drawn {
  speeds_kmh: number[]
  torque_rates: number[]
  gain: number[][]
  engine: string
}

export class SurfacePreview {
  drawn = $state.raw<Drawn | null>(null)
  lint = $state.raw<LintReport | null>(null)
  trouble = $state<string | null>(null)
  private asked = new AbortController()

  constructor(private readonly server: Server) {}

  async ask(question: LintRequest): Promise<void> {
    const table = question.fuzzy_table
    this.asked.abort()
    this.asked = new AbortController()
    const { signal } = this.asked
    const speeds_kmh = spread(0, table.speed_points_kmh[4] ?? 25, POINTS)
    const rates = table.torque_rate_points
    const torque_rates = spread(rates[0] ?? 0, rates[4] ?? 1, POINTS)
    try {
      // The findings take longer, as they are proven; the surface does not wait for them.
      await Promise.all([
        this.server.surface(table, speeds_kmh, torque_rates, signal).then(({ gain, engine }) => {
          if (!signal.aborted) this.drawn = { speeds_kmh, torque_rates, gain, engine }
        }),
        this.server.lint(question, signal).then((lint) => {
          if (!signal.aborted) this.lint = lint
        }),
      ])
      if (!signal.aborted) this.trouble = null
    } catch (error) {
      if (signal.aborted) return
      if (!(error instanceof Refusal)) throw error
      this.trouble = error.message
    }
  }

  stop(): void {
    this.asked.abort()
  }
}

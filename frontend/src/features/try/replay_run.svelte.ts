// One replay after another: the newest question wins, and the answer before it stays meanwhile.
import { Refusal } from '$shared/api/client'
import type { Series } from '$shared/api/series'
import type { Server } from '$shared/api/server'
import type { Replay, ReplayRequest } from '$shared/api/types'
import { TraceWindow } from '$shared/charts/trace_window.svelte'
import { drawnSeries } from './answer'

export interface Answered {
  replay: Replay
  series: Series
  view: TraceWindow
}

export class ReplayRun {
  answered = $state.raw<Answered | null>(null)
  refused = $state.raw<Refusal | null>(null)
  running = $state(false)
  private asked = new AbortController()

  constructor(private readonly server: Server) {}

  async ask(ride_id: number, question: ReplayRequest): Promise<void> {
    this.stop()
    this.asked = new AbortController()
    const { signal } = this.asked
    this.running = true
    try {
      const replay = await this.server.replay(ride_id, question, signal)
      if (!signal.aborted) this.take(replay)
    } catch (error) {
      if (signal.aborted) return
      if (!(error instanceof Refusal)) throw error
      this.answered = null
      this.refused = error
    }
    if (!signal.aborted) this.running = false
  }

  /** Gives up what is asked; what was answered stays. */
  stop(): void {
    this.asked.abort()
    this.running = false
  }

  private take(replay: Replay): void {
    const series = drawnSeries(replay)
    // The same stretch of the same ride stays in view, so that two candidates can be compared.
    const before = this.answered
    const view =
      before?.replay.ride_id === replay.ride_id ? before.view : new TraceWindow(replay.duration_s)
    view.series = series
    this.answered = { replay, series, view }
    this.refused = null
  }
}

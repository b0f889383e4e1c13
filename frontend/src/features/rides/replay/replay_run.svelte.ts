// One replay after another: the newest question wins, and the answer before it stays meanwhile.
import { NewestAnswer } from '$shared/api/newest_answer.svelte'
import type { Series } from '$shared/api/series'
import type { Server } from '$shared/api/server'
import type { Replay } from '$shared/api/types'
import { TraceWindow } from '$shared/charts/traces/trace_window.svelte'
import { drawnSeries } from './answer'
import type { Settings } from './candidate'

export interface Answered {
  replay: Replay
  series: Series
  view: TraceWindow
}

export class ReplayRun {
  readonly newest = new NewestAnswer<Answered>()

  constructor(private readonly server: Server) {}

  request(ride_id: number, parameters: Settings): Promise<void> {
    return this.newest.request(async (signal) => {
      const replay = await this.server.replay(ride_id, { mode: 'open_loop', parameters }, signal)
      signal.throwIfAborted()
      return this.seen(replay)
    })
  }

  private seen(replay: Replay): Answered {
    const series = drawnSeries(replay)
    // The same stretch of the same ride stays in view, so that two candidates can be compared.
    const before = this.newest.value
    const view =
      before?.replay.ride_id === replay.ride_id ? before.view : new TraceWindow(replay.duration_s)
    view.series = series
    return { replay, series, view }
  }
}

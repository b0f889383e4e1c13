// Rides in a unit's own flash. The download runs on the server: leaving the page or reloading it
// breaks nothing off.
import { Refusal } from '$shared/api/client'
import type { Server } from '$shared/api/server'
import type { UnitLog } from '$shared/api/types'
import type { Locale } from '$shared/i18n/locale.svelte'
import { refusalText } from '$shared/i18n/refusal_text'

const BUSY_MS = 500
const QUIET_MS = 5000

export const isFetched = (log: UnitLog) => log.download?.state === 'done'
export const isRunning = (log: UnitLog) =>
  log.download !== null && !['done', 'failed'].includes(log.download.state)
/** Whether it is not downloaded and no download is under way. */
export const isUnfetched = (log: UnitLog) =>
  log.state !== 'recording' && !log.confirmed && !isFetched(log) && !isRunning(log)

export class UnitRides {
  logs = $state.raw<UnitLog[] | null>(null)
  overwritten = $state(0)
  problem = $state<string | null>(null)
  /** This unit stores none. */
  none = $state(false)
  /** Whether the first request was sent, or none was possible. */
  loaded = $state(false)
  private done = 0
  private running = true
  private timer: ReturnType<typeof setTimeout> | undefined

  constructor(
    readonly id: string,
    private readonly server: Server,
    private readonly locale: Locale,
    private readonly isReady: () => boolean,
    private readonly arrived: () => void,
  ) {}

  get unfetched(): UnitLog[] {
    return (this.logs ?? []).filter(isUnfetched)
  }

  /** Polls the unit until stopped. */
  async watch(): Promise<void> {
    if (!document.hidden && this.isReady()) await this.load()
    this.loaded = true
    const soon = (this.logs === null && !this.problem) || this.logs?.some(isRunning)
    if (!this.running) return
    this.timer = setTimeout(() => void this.watch(), soon ? BUSY_MS : QUIET_MS)
  }

  stop(): void {
    this.running = false
    clearTimeout(this.timer)
  }

  /** Has them fetched one after the other; failures are shown. */
  fetch(logs: UnitLog[]): Promise<boolean> {
    return this.trying(async () => {
      for (const { log_id } of logs) await this.server.fetchLog(this.id, log_id)
    })
  }

  erase({ log_id }: UnitLog): Promise<boolean> {
    return this.trying(() => this.server.eraseLog(this.id, log_id))
  }

  private async trying(work: () => Promise<void>): Promise<boolean> {
    try {
      await work()
    } catch (error) {
      if (!(error instanceof Refusal)) throw error
      this.problem = refusalText(this.locale, error)
      return false
    }
    await this.load()
    return true
  }

  private async load(): Promise<void> {
    try {
      const answer = await this.server.unitLogs(this.id)
      this.logs = [...answer.items].reverse()
      this.overwritten = answer.overwritten
      this.problem = null
      const count = this.logs.filter(isFetched).length
      if (count > this.done) this.arrived()
      this.done = count
    } catch (error) {
      if (!(error instanceof Refusal)) throw error
      this.none = error.status === 409 && this.logs === null
      this.problem = refusalText(this.locale, error)
    }
  }
}

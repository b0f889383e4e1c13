// Which units there are and how their links stand, asked once a second while the page is seen.
import { Refusal } from './client'
import type { Server } from './server'
import type { Device } from './types'

const PERIOD_MS = 1000

export class DeviceWatch {
  items = $state.raw<Device[]>([])
  known = $state(false) // false until the server answered once
  unreachable = $state(false)
  chosen_id = $state<string | null>(null)
  now_ms = $state(Date.now())
  current = $derived(this.items.find((d) => d.id === this.chosen_id) ?? this.items[0] ?? null)
  private seen_ms = $state.raw<Record<string, number>>({})
  private timer: ReturnType<typeof setTimeout> | null = null
  private stopped = false

  constructor(
    private readonly server: Server,
    chosen_id: string | null,
  ) {
    this.chosen_id = chosen_id
  }

  start(): void {
    document.addEventListener('visibilitychange', this.wake)
    window.addEventListener('online', this.wake)
    void this.ask()
  }

  stop(): void {
    this.stopped = true
    if (this.timer) clearTimeout(this.timer)
    document.removeEventListener('visibilitychange', this.wake)
    window.removeEventListener('online', this.wake)
  }

  /** Whether the current unit answers and may be written to. */
  get ready(): boolean {
    return this.current?.state === 'ready' && !this.unreachable
  }

  /** Seconds since the current unit last answered; null if it never did. */
  get age_s(): number | null {
    const seen = this.current ? this.seen_ms[this.current.id] : undefined
    return seen === undefined ? null : Math.max(0, (this.now_ms - seen) / 1000)
  }

  /** Asks now; also after something was connected or removed. */
  async refresh(): Promise<void> {
    try {
      const items = await this.server.devices()
      const now_ms = Date.now()
      const alive = items.filter((d) => d.state === 'ready' || d.state === 'read_only')
      this.seen_ms = { ...this.seen_ms, ...Object.fromEntries(alive.map((d) => [d.id, now_ms])) }
      this.items = items
      this.known = true
      this.unreachable = false
    } catch (error) {
      if (!(error instanceof Refusal)) throw error
      this.unreachable = true
    }
    this.now_ms = Date.now()
  }

  private readonly wake = (): void => {
    if (!document.hidden) void this.ask()
  }

  private async ask(): Promise<void> {
    if (this.timer) clearTimeout(this.timer)
    if (!document.hidden) await this.refresh()
    if (!this.stopped) this.timer = setTimeout(() => void this.ask(), PERIOD_MS)
  }
}

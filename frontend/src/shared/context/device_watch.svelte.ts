// Which units there are and how their links stand, asked once a second while the page is visible.
import { Refusal } from '../api/client'
import type { Server } from '../api/server'
import type { Device } from '../api/types'
import { PollWhileVisible } from './poll_while_visible'

const PERIOD_MS = 1000

export class DeviceWatch {
  items = $state.raw<Device[]>([])
  known = $state(false) // false until the server answered once
  unreachable = $state(false)
  chosen_id = $state<string | null>(null)
  now_ms = $state(Date.now())
  current = $derived(this.items.find((d) => d.id === this.chosen_id) ?? this.items[0] ?? null)
  private seen_ms = $state.raw<Record<string, number>>({})
  private readonly polling = new PollWhileVisible(() => this.refresh(), PERIOD_MS)

  constructor(
    private readonly server: Server,
    chosen_id: string | null,
  ) {
    this.chosen_id = chosen_id
  }

  start(): void {
    this.polling.start()
  }

  stop(): void {
    this.polling.stop()
  }

  /** Whether the current unit answers and may be written to. */
  get ready(): boolean {
    return this.current?.state === 'ready' && !this.unreachable
  }

  /** When the current unit last answered, as a time in ms; null if it never did. */
  get seen_at_ms(): number | null {
    return (this.current && this.seen_ms[this.current.id]) ?? null
  }

  /** Seconds since then; null if it never answered. */
  get age_s(): number | null {
    const seen = this.seen_at_ms
    return seen === null ? null : Math.max(0, (this.now_ms - seen) / 1000)
  }

  /** Asks now; also after something was connected or removed. */
  async refresh(): Promise<void> {
    try {
      const items = await this.server.devices()
      const now_ms = Date.now()
      const alive = items.filter((d) => d.state === 'ready' || d.state === 'read_only')
      this.seen_ms = { ...this.seen_ms, ...Object.fromEntries(alive.map((d) => [d.id, now_ms])) }
      this.items = items
      // A choice that an earlier version kept is a serial number.
      const serial = this.chosen_id
      const chosen = items.find((d) => serial && d.identity?.serial_number === serial)
      if (chosen) this.chosen_id = chosen.id
      this.known = true
      this.unreachable = false
    } catch (error) {
      if (!(error instanceof Refusal)) throw error
      this.unreachable = true
    }
    this.now_ms = Date.now()
  }
}

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
  current = $derived(this.items.find((d) => d.id === this.chosen_id) ?? this.items[0] ?? null)
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

  /** When the current unit was last there, as a time in ms; null if it never was. The server keeps
      it, so that it outlives this page. */
  get seen_at_ms(): number | null {
    const seen_at = this.current?.last_seen_at
    return seen_at ? Date.parse(seen_at) : null
  }

  /** Whether the current unit was here and is not: what is known of it is as it was then. */
  get away(): boolean {
    const state = this.current?.state
    return this.seen_at_ms !== null && state !== 'ready' && state !== 'read_only'
  }

  /** Asks now; also after something was connected or removed. */
  async refresh(): Promise<void> {
    try {
      const items = await this.server.devices()
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
  }
}

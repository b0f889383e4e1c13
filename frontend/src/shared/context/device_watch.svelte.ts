// Which units there are and how their links stand, polled once a second while the page is visible.
import { Refusal } from '../api/client'
import type { Server } from '../api/server'
import type { Device, Snapshot } from '../api/types'
import { PollWhileVisible } from './poll_while_visible'

const PERIOD_MS = 1000

export class DeviceWatch {
  items = $state.raw<Device[]>([])
  loaded = $state(false) // false until the server answered once
  unreachable = $state(false)
  chosen_id = $state<string | null>(null)
  /** The unit in whose place another one is, as it was last seen; null once it is back or its
      absence was acknowledged. */
  replaced = $state.raw<Device | null>(null)
  /** How often another unit came into the place of the current one. */
  replacements = $state(0)
  /** Values come one by one, because no socket passes; shown on every page. */
  polled = $state(false)
  current = $derived(this.items.find((d) => d.id === this.chosen_id) ?? this.items[0] ?? null)
  private readonly polling = new PollWhileVisible(() => this.refresh(), PERIOD_MS)

  constructor(
    private readonly server: Server,
    chosen_id: string | null,
  ) {
    this.chosen_id = chosen_id
  }

  /** For who may not see units: there are none to wait for. */
  startWithout(): void {
    this.loaded = true
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

  /** When the current unit was last there, as a time in ms; null if it never was. The server stores
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

  newest(device_id: string): Promise<Snapshot> {
    return this.server.snapshot(device_id)
  }

  keyOf(device_id: string): string | null {
    return this.items.find((d) => d.id === device_id)?.unit_key ?? null
  }

  /** A unit that is on another port now stays the chosen one. */
  private followMoved(before: Device | null): void {
    if (!before?.unit_key || this.items.some((d) => d.id === before.id)) return
    this.chosen_id = this.items.find((d) => d.unit_key === before.unit_key)?.id ?? this.chosen_id
  }

  private noteReplaced(before: Device | null): void {
    const now = this.current
    if (!before || before.id !== now?.id || !isAnother(before.unit_key, now.unit_key)) return
    this.replaced = now.unit_key === this.replaced?.unit_key ? null : before
    this.replacements += 1
  }

  /** Polls now; also after something was connected or removed. */
  async refresh(): Promise<void> {
    try {
      const items = await this.server.devices()
      const before = this.current
      this.items = items
      this.followMoved(before)
      this.noteReplaced(before)
      // A choice that an earlier version stored is a serial number.
      const serial = this.chosen_id
      const chosen = items.find((d) => serial && d.identity?.serial_number === serial)
      if (chosen) this.chosen_id = chosen.id
      this.loaded = true
      this.unreachable = false
    } catch (error) {
      if (!(error instanceof Refusal)) throw error
      this.unreachable = true
    }
  }
}

/** Whether two keys are of two units: one without a name of its own may have got it
    meanwhile. */
function isAnother(before: string | null, now: string | null): boolean {
  return before !== null && now !== null && before !== now && !before.includes(':url:')
}

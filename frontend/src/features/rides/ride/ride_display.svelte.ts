// How one ride is displayed: its window, axis, rows and cursor, and the address that holds them.
import { NewestAnswer } from '$shared/api/newest_answer.svelte'
import type { Server } from '$shared/api/server'
import type { Ride, RideEnergy, Track } from '$shared/api/types'
import { ofRide, RideView } from '$shared/charts/traces/ride_view.svelte'
import { LaidAxis, timeAxis, type AxisKind, type TraceAxis } from '$shared/charts/traces/trace_axis'
import type { Cursor, TraceRow } from '$shared/charts/traces/trace_line'
import { CursorReading } from './cursor_reading.svelte'
import { modeSpans, type ModeSpan } from './shape/modes'
import { storedRows, storeRows } from './stored_rows'
import { rowsOf } from './traces'

const AROUND_S = 30
const KINDS: readonly AxisKind[] = ['time', 'moving', 'distance']

export class RideDisplay implements Cursor {
  readonly view: RideView | null
  readonly rows: TraceRow[]
  readonly missing: string[]
  readonly modes: ModeSpan[]
  readonly reading: CursorReading
  readonly energy = new NewestAnswer<RideEnergy>()
  readonly end_s: number
  track = $state.raw<Track | null>(null)
  t_s = $state<number | null>(null)
  keys = $state.raw<string[]>([])
  axis = $state<AxisKind>('time')

  constructor(
    private readonly server: Server,
    readonly ride: Ride,
    query: URLSearchParams,
  ) {
    const { all, usual, missing } = rowsOf(ride)
    const requested = query.get('show')?.split(',') ?? storedRows()
    const available = all.map((row) => row.key)
    const chosen = requested.filter((key) => available.includes(key))
    this.rows = all
    this.missing = missing
    this.keys = chosen.length > 0 ? chosen : usual
    this.usual = usual
    this.end_s = ride.summary?.duration_s ?? 0
    this.modes = modeSpans(ride.events, this.end_s)
    this.reading = new CursorReading(server, ride)
    const drawn = all.length > 0 && this.end_s > 0 && ride.state === 'done'
    this.view = drawn
      ? new RideView(ofRide(server, ride.id), this.channels, this.end_s, windowIn(query))
      : null
    const t_s = numberIn(query, 't_s')
    if (t_s !== null) this.move(t_s)
    this.requested_axis = KINDS.find((kind) => kind === query.get('axis')) ?? 'time'
  }

  private readonly usual: string[]
  private readonly requested_axis: AxisKind
  private readonly left = new AbortController()

  /** Fetches what is shown with the traces. */
  async load(): Promise<void> {
    const { id, state } = this.ride
    if (state === 'done') void this.energy.request((signal) => this.server.energy(id, signal))
    if (!this.view) return
    // The page says by itself what is wrong with a ride.
    const { signal } = this.left
    this.track = await this.server.track(id, signal).catch(() => null)
    if (signal.aborted) return
    if (this.requested_axis !== 'time') this.lay(this.requested_axis)
  }

  get shown(): TraceRow[] {
    return this.rows.filter((row) => this.keys.includes(row.key))
  }

  get channels(): string[] {
    return this.shown.flatMap((row) => row.lines.map((line) => line.channel))
  }

  /** The axes that this ride has. */
  offers(kind: AxisKind): boolean {
    return kind === 'time' || this.axisOf(kind) !== timeAxis
  }

  axisOf(kind: AxisKind): TraceAxis {
    const points = { time: null, moving: this.track?.moving_s, distance: this.track?.distance_m }
    const x = points[kind]
    return this.track && x ? new LaidAxis(kind, this.track.t_s, x) : timeAxis
  }

  lay(kind: AxisKind): void {
    if (!this.view || !this.offers(kind)) return
    this.axis = kind
    this.view.lay(this.axisOf(kind), this.view.px)
  }

  /** Shows or hides a row; the last one stays. */
  toggle(key: string): void {
    const keys = this.keys.includes(key)
      ? this.keys.filter((one) => one !== key)
      : this.rows.map((row) => row.key).filter((one) => one === key || this.keys.includes(one))
    if (keys.length === 0) return
    this.keys = keys
    storeRows(keys.join() === this.usual.join() ? [] : keys)
    this.view?.choose(this.channels, this.view.px)
  }

  readonly move = (t_s: number): void => {
    this.t_s = Math.max(0, Math.min(t_s, this.end_s))
    this.reading.at(this.t_s)
    const { view } = this
    if (!view || (this.t_s >= view.window.from_s && this.t_s <= view.window.to_s)) return
    const half_s = (view.window.to_s - view.window.from_s) / 2
    view.show({ from_s: this.t_s - half_s, to_s: this.t_s + half_s }, view.px)
  }

  /** The window around a moment, and the cursor on it. */
  readonly show = (t_s: number): void => {
    this.view?.show({ from_s: t_s - AROUND_S, to_s: t_s + AROUND_S }, this.view.px)
    this.move(t_s)
  }

  /** Acts on a key; false where it means nothing here. */
  key({ key, shiftKey }: { key: string; shiftKey: boolean }): boolean {
    const { view } = this
    if (!view) return false
    const { from_s, to_s } = view.window
    const step_s = shiftKey ? 60 : to_s - from_s < 60 ? 0.1 : 1
    const from = this.t_s ?? (from_s + to_s) / 2
    const acts: Record<string, () => void> = {
      ArrowLeft: () => this.move(from - step_s),
      ArrowRight: () => this.move(from + step_s),
      '+': () => view.zoom(0.5, view.px),
      '=': () => view.zoom(0.5, view.px),
      '-': () => view.zoom(2, view.px),
      w: () => view.showAll(view.px),
      n: () => this.next(),
    }
    const act = acts[key.length === 1 ? key.toLowerCase() : key]
    act?.()
    return act !== undefined
  }

  /** The event after the cursor; after the last one the first. */
  private next(): void {
    const { events } = this.ride
    const next = events.find(({ t_s }) => t_s > (this.t_s ?? -1) + 0.001) ?? events[0]
    if (next) this.show(next.t_s)
  }

  /** What a link holds, so that it shows what its sender saw. */
  get query(): string {
    const parts: string[] = []
    if (this.view && !this.view.is_complete) {
      const { from_s, to_s } = this.view.window
      parts.push(`from_s=${from_s.toFixed(2)}`, `to_s=${to_s.toFixed(2)}`)
    }
    // Until the track is here, the link's own.
    const axis = this.track ? this.axis : this.requested_axis
    if (axis !== 'time') parts.push(`axis=${axis}`)
    if (this.keys.join() !== this.usual.join()) {
      parts.push(`show=${this.keys.map(encodeURIComponent).join()}`)
    }
    if (this.t_s !== null) parts.push(`t_s=${this.t_s.toFixed(2)}`)
    return parts.length > 0 ? `?${parts.join('&')}` : ''
  }

  stop(): void {
    this.left.abort()
    this.energy.stop()
    this.view?.stop()
    this.reading.stop()
  }
}

function numberIn(query: URLSearchParams, name: string): number | null {
  const text = query.get(name)
  return text !== null && Number.isFinite(Number(text)) ? Number(text) : null
}

function windowIn(query: URLSearchParams): { from_s: number; to_s: number } | null {
  const [from_s, to_s] = [numberIn(query, 'from_s'), numberIn(query, 'to_s')]
  return from_s !== null && to_s !== null && to_s > from_s ? { from_s, to_s } : null
}

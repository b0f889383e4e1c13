// How two rides are displayed: windows, axis, channels, cursor, and the address that holds them.
import { NewestAnswer } from '$shared/api/newest_answer.svelte'
import { PairOfRides } from '$shared/api/pair_of_rides'
import type { Server } from '$shared/api/server'
import type {
  ComparedChannel,
  ComparedCrank,
  ComparedPair,
  RideComparison,
} from '$shared/api/types'
import { RideView } from '$shared/charts/traces/ride_view.svelte'
import { timeAxis, type TraceAxis } from '$shared/charts/traces/trace_axis'
import type { Cursor, Span } from '$shared/charts/traces/trace_line'
import { inOrder, seriesOf, usualOf } from './compared'

export const KINDS = ['time', 'distance', 'crank'] as const
export type By = (typeof KINDS)[number]
export type SideName = 'a' | 'b'

export interface Side {
  /** Null until one is chosen. */
  id: number | null
  /** Seconds since the ride's start; null for its ends. */
  from_s: number | null
  to_s: number | null
}

const distanceAxis: TraceAxis = { kind: 'distance', at: (x) => x, moment: (x) => x }

export class CompareDisplay implements Cursor {
  readonly comparison = new NewestAnswer<RideComparison>()
  readonly crank = new NewestAnswer<ComparedCrank>()
  a = $state.raw<Side>({ id: null, from_s: null, to_s: null })
  b = $state.raw<Side>({ id: null, from_s: null, to_s: null })
  by = $state<By>('time')
  names = $state.raw<string[]>([])
  view = $state.raw<RideView | null>(null)
  /** Of either, on the axis. */
  gaps = $state.raw<Span[]>([])
  /** The place under the cursor: seconds or metres since the start. */
  t_s = $state<number | null>(null)
  private readonly server: PairOfRides
  private requested: string[]
  private span: { from_s: number; to_s: number } | null

  constructor({ http }: Server, query: URLSearchParams) {
    this.server = new PairOfRides(http)
    const number = (name: string) => {
      const text = query.get(name)
      return text !== null && Number.isFinite(Number(text)) ? Number(text) : null
    }
    const side = (name: SideName): Side => ({
      id: number(name),
      from_s: number(`${name}_from_s`),
      to_s: number(`${name}_to_s`),
    })
    this.a = side('a')
    this.b = side('b')
    this.by = KINDS.find((kind) => kind === query.get('by')) ?? 'time'
    this.requested = query.get('show')?.split(',') ?? []
    const [low, high] = [number('from_x'), number('to_x')]
    this.span = low !== null && high !== null && high > low ? { from_s: low, to_s: high } : null
    this.t_s = number('x')
  }

  /** The requested pair; null until both rides are chosen. */
  get pair(): ComparedPair | null {
    const { a, b } = this
    if (a.id === null || b.id === null) return null
    const ends = { a_from_s: a.from_s, a_to_s: a.to_s, b_from_s: b.from_s, b_to_s: b.to_s }
    const given = Object.entries(ends).filter(([, value]) => value !== null)
    return { a: a.id, b: b.id, ...Object.fromEntries(given) }
  }

  get channels(): ComparedChannel[] {
    return inOrder(this.comparison.value?.channels ?? [])
  }

  get shown(): ComparedChannel[] {
    return this.channels.filter(({ name }) => this.names.includes(name))
  }

  /** Whether both rides have an axis. */
  offers(by: By): boolean {
    const answer = this.comparison.value
    return by !== 'distance' || !!(answer?.a.length_m && answer.b.length_m)
  }

  async load(): Promise<void> {
    const { pair } = this
    this.view?.stop()
    this.view = null
    if (!pair) return
    await this.comparison.request((signal) => this.server.figures(pair, signal))
    const answer = this.comparison.value
    if (!answer) return
    const present = answer.channels.map(({ name }) => name)
    const names = this.requested.filter((name) => present.includes(name))
    this.names = names.length > 0 ? names : usualOf(answer.channels)
    this.lay(this.offers(this.by) ? this.by : 'time', true)
  }

  /** Chooses a side; the display of the old pair is dropped. */
  choose(name: SideName, side: Side): void {
    this[name] = side
    this.forget()
    void this.load()
  }

  swap(): void {
    ;[this.a, this.b] = [this.b, this.a]
    this.forget()
    void this.load()
  }

  lay(by: By, first = false): void {
    if (!first) this.forget()
    this.by = by
    this.view?.stop()
    this.view = null
    const [pair, answer] = [this.pair, this.comparison.value]
    if (!pair || !answer) return
    if (by === 'crank') {
      void this.crank.request((signal) => this.server.crank(pair, signal))
      return
    }
    if (this.names.length === 0) return
    const length = by === 'time' ? 'length_s' : 'length_m'
    const lengths = [answer.a[length], answer.b[length]]
    const fetchSeries = async (
      channels: string[],
      { px, from_s, to_s }: { px: number; from_s?: number; to_s?: number },
      signal: AbortSignal,
    ) => {
      const part = { from_x: from_s ?? 0, to_x: to_s ?? null }
      const query = { ...pair, by, channels: channels.join(','), px, ...part }
      const series = await this.server.series(query, signal)
      const gaps = [...series.a_gaps, ...series.b_gaps]
      this.gaps = gaps.map(({ from_x, to_x }) => ({ from_s: from_x, to_s: to_x }))
      return seriesOf(series)
    }
    const end = Math.max(...lengths.map((one) => one ?? 0))
    const axis = by === 'time' ? timeAxis : distanceAxis
    this.view = new RideView(fetchSeries, this.names, end, this.span, axis)
  }

  /** Shows or hides a channel; the last one stays. */
  toggle(name: string): void {
    const on = this.names.includes(name)
    const names = on ? this.names.filter((one) => one !== name) : [...this.names, name]
    if (names.length === 0) return
    this.names = names
    this.requested = names
    this.view?.choose(names, this.view.px)
  }

  readonly move = (t_s: number): void => {
    if (!this.view) return
    this.t_s = Math.max(0, Math.min(t_s, this.view.duration_s))
  }

  /** Acts on a key; false where it means nothing here. */
  key({ key, shiftKey }: { key: string; shiftKey: boolean }): boolean {
    const { view } = this
    if (!view || !key.startsWith('Arrow')) return false
    const { from_s, to_s } = view.window
    const step = ((to_s - from_s) / 100) * (shiftKey ? 10 : 1)
    const from = this.t_s ?? (from_s + to_s) / 2
    if (key === 'ArrowLeft') this.move(Math.max(from_s, from - step))
    else if (key === 'ArrowRight') this.move(Math.min(to_s, from + step))
    else return false
    return true
  }

  /** What a link holds, so that it shows what its sender saw. */
  get query(): string {
    const parts: string[] = []
    for (const name of ['a', 'b'] as const) {
      const { id, from_s, to_s } = this[name]
      if (id !== null) parts.push(`${name}=${id}`)
      if (from_s !== null) parts.push(`${name}_from_s=${from_s}`)
      if (to_s !== null) parts.push(`${name}_to_s=${to_s}`)
    }
    const { by, view, names, t_s } = this
    if (by !== 'time') parts.push(`by=${by}`)
    if (names.length > 0 && names.join() !== usualOf(this.channels).join()) {
      parts.push(`show=${names.map(encodeURIComponent).join()}`)
    }
    if (view && !view.is_complete) {
      const { from_s, to_s } = view.window
      parts.push(`from_x=${from_s.toFixed(2)}`, `to_x=${to_s.toFixed(2)}`)
    }
    if (view && t_s !== null) parts.push(`x=${t_s.toFixed(2)}`)
    return parts.length > 0 ? `?${parts.join('&')}` : ''
  }

  stop(): void {
    this.comparison.stop()
    this.crank.stop()
    this.view?.stop()
  }

  private forget(): void {
    this.span = null
    this.t_s = null
  }
}

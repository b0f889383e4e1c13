// One device's live socket: rows into a buffer, the newest values ten times a second, and the
// truth about age, gaps and reconnecting.
import {
  readFrame,
  valueOf,
  type StreamError,
  type StreamFrame,
  type StreamHeader,
  type StreamState,
} from './frame'
import { hangUp } from './hang_up'
import type { Newest } from './polled'
import { TraceBuffer } from './trace_buffer'

const STALE_AFTER_MS = 1500 // a rider's glance: older than this must not count as live
const GONE = ['lost', 'closed'] // a unit known to be away has no live values, however young
const SILENT_AFTER_MS = 5000 // an open socket without frames is dead (Wi-Fi change, sleep)
const RETRY_MS_MAX = 3000
const TICK_MS = 100
// Two seconds without one that opened: by then a server that is away is known to be.
const FAILURES_MIN = 4
const RETRY_POLLED_MS = 10_000

/** How values come where no socket passes. */
export interface Instead {
  /** Whether the server does not answer at all. */
  readonly unreachable: boolean
  /** Whether values are polled one by one. */
  polled: boolean
  newest(device_id: string): Promise<Newest>
}

export type Latest = Record<string, number | null>

export interface LiveOptions {
  device_id: string
  channels: string[]
  rate_hz: number
  window_s?: number
}

export class LiveStream {
  readonly buffer: TraceBuffer
  header = $state.raw<StreamHeader | null>(null)
  latest = $state.raw<Latest>({})
  age_ms = $state(Infinity)
  gaps = $state(0)
  lost_rows = $state(0)
  link_state = $state<string | null>(null)
  reason = $state<string | null>(null)

  private socket: WebSocket | null = null
  private newest: StreamFrame | null = null
  private arrived_ms = -Infinity
  private opened_ms = 0
  private retry_ms = 250
  private timers: ReturnType<typeof setTimeout>[] = []
  private ticker: ReturnType<typeof setInterval> | null = null
  private closed = false
  private failures = 0 // since a socket last received something
  private stopPolling: (() => void) | null = null

  constructor(
    private readonly options: LiveOptions,
    private readonly instead: Instead,
  ) {
    this.buffer = new TraceBuffer(options.window_s ?? 30)
  }

  /** Whether what is shown is too old to count as live. */
  get stale(): boolean {
    const gone = this.link_state !== null && GONE.includes(this.link_state)
    return gone || this.age_ms > STALE_AFTER_MS
  }

  /** Opens the socket and keeps it open until `close`. */
  open(): void {
    this.connect()
    this.ticker = setInterval(() => this.tick(), TICK_MS)
    document.addEventListener('visibilitychange', this.wake)
    window.addEventListener('online', this.wake)
  }

  close(): void {
    this.closed = true
    if (this.ticker) clearInterval(this.ticker)
    this.timers.forEach(clearTimeout)
    document.removeEventListener('visibilitychange', this.wake)
    window.removeEventListener('online', this.wake)
    if (this.socket) hangUp(this.socket)
    this.stopPolling?.()
  }

  /** Index of a channel in the buffer's columns, or -1. */
  column(name: string): number {
    return this.header?.channels.findIndex((channel) => channel.name === name) ?? -1
  }

  private url(): string {
    const { device_id, channels, rate_hz } = this.options
    const server = document.baseURI.replace(/^http/, 'ws')
    const path = `api/v1/devices/${encodeURIComponent(device_id)}/live`
    return `${server}${path}?channels=${channels.join(',')}&rate_hz=${rate_hz}`
  }

  private connect(): void {
    if (this.closed) return
    this.opened_ms = performance.now()
    const socket = new WebSocket(this.url())
    socket.binaryType = 'arraybuffer'
    socket.onmessage = (event: MessageEvent<string | ArrayBuffer>) => this.receive(event.data)
    socket.onclose = () => this.lost(socket)
    this.socket = socket
  }

  private lost(socket: WebSocket): void {
    if (socket !== this.socket || this.closed) return
    this.socket = null
    this.failed()
    this.timers = [setTimeout(() => this.connect(), this.retry_ms)]
    this.retry_ms = Math.min(RETRY_MS_MAX, this.retry_ms * 2)
    if (this.instead.polled) this.retry_ms = RETRY_POLLED_MS
  }

  private failed(): void {
    const { instead, options } = this
    if (++this.failures < FAILURES_MIN && !instead.polled) return
    if (instead.unreachable || this.stopPolling) return
    void import('./polled').then(({ poll }) => {
      if (this.closed || this.failures === 0) return
      this.stopPolling ??= poll(this, options.channels, () => instead.newest(options.device_id))
      instead.polled = true
      this.link_state = null // reported by sockets
    })
  }

  private markAlive(): void {
    this.failures = 0
    this.stopPolling?.()
    this.stopPolling = null
    this.instead.polled = false
  }

  // After sleep or a network change the old socket may seem open for minutes: reconnect.
  private readonly wake = (): void => {
    if (document.hidden || this.age_ms < STALE_AFTER_MS) return
    this.reconnect()
  }

  private reconnect(): void {
    this.timers.forEach(clearTimeout)
    const old = this.socket
    this.socket = null
    if (old) hangUp(old)
    this.retry_ms = 250
    this.connect()
  }

  private receive(data: string | ArrayBuffer): void {
    if (typeof data === 'string') this.receiveText(data)
    else this.receiveRows(data)
  }

  private receiveText(text: string): void {
    const message = JSON.parse(text) as StreamHeader | StreamState | StreamError
    this.markAlive()
    if (message.type === 'stream') {
      this.begin(message)
    } else if (message.type === 'state') {
      this.link_state = message.state
      this.reason = message.reason
    } else {
      this.reason = message.detail
      this.retry_ms = RETRY_MS_MAX
    }
  }

  private receiveRows(bytes: ArrayBuffer): void {
    const frame = readFrame(bytes)
    if (!frame || frame.rows === 0) return
    this.retry_ms = 250
    this.take(frame)
  }

  /** Rows of these channels follow. */
  begin(header: StreamHeader): void {
    this.buffer.reset(header)
    this.newest = null
    this.header = header
  }

  take(frame: StreamFrame): void {
    this.arrived_ms = performance.now()
    if (frame.lost_rows > 0) {
      this.gaps += 1
      this.lost_rows += frame.lost_rows
    }
    this.buffer.append(frame)
    this.newest = frame
  }

  private tick(): void {
    const now_ms = performance.now()
    this.age_ms = now_ms - this.arrived_ms
    const silent_ms = now_ms - Math.max(this.arrived_ms, this.opened_ms)
    const opened = this.link_state !== null
    if (this.socket && silent_ms > SILENT_AFTER_MS && (this.link_state === 'ready' || !opened)) {
      if (!opened) this.failed()
      this.reconnect()
    }
    if (this.newest && this.header) this.latest = lastRow(this.newest, this.header)
  }
}

function lastRow(frame: StreamFrame, header: StreamHeader): Latest {
  const start = (frame.rows - 1) * frame.channels
  return Object.fromEntries(
    header.channels.map((channel, i) => [
      channel.name,
      valueOf(frame.counts[start + i], channel.scale),
    ]),
  )
}

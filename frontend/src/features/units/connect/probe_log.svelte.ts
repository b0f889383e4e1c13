// What the server reported of each connection while this page was open, in its order.
import type { Device } from '$shared/api/types'

/** One report of the server; reason and state are its own words. */
export interface ProbeLine {
  number: number
  after_s: number
  state: Device['state']
  reason: string
  reason_code: string
}

// A unit that is away is tried for ever; the last tries are enough.
const LINES = 8

/** Notes a connection's state and reason whenever one of them is new. */
export class ProbeLog {
  private lines_of = $state.raw<Readonly<Record<string, readonly ProbeLine[]>>>({})
  private begun_ms: Readonly<Record<string, number>> = {}

  note(device: Device, now_ms: number): void {
    const { id, state, reason, reason_code } = device
    const before = this.of(id)
    const last = before.at(-1)
    if (last?.state === state && last.reason === reason) return
    const begun_ms = this.begun_ms[id] ?? now_ms
    this.begun_ms = { ...this.begun_ms, [id]: begun_ms }
    const number = (last?.number ?? 0) + 1
    const line = { number, after_s: (now_ms - begun_ms) / 1000, state, reason, reason_code }
    this.lines_of = { ...this.lines_of, [id]: [...before, line].slice(-LINES) }
  }

  /** A connection is requested again: its log begins again. */
  begin(device: Device, now_ms: number): void {
    this.begun_ms = { ...this.begun_ms, [device.id]: now_ms }
    this.lines_of = { ...this.lines_of, [device.id]: [] }
    this.note(device, now_ms)
  }

  of(id: string): readonly ProbeLine[] {
    return this.lines_of[id] ?? []
  }
}

/** How far a connection is, in one of few words; each has a sentence of its own. */
export function probeResult(device: Pick<Device, 'state' | 'reason_code'>): ProbeResult {
  if (device.state === 'ready') return 'connected'
  if (device.state === 'read_only') return 'older'
  return RESULTS[device.reason_code] ?? 'failed'
}

const RESULTS: Readonly<Record<string, ProbeResult>> = {
  opening: 'probing',
  greeted: 'probing',
  restarted: 'probing',
  orphan: 'probing',
  port_busy: 'busy',
  port_permission: 'forbidden',
  port_absent: 'absent',
  port_vanished: 'absent',
  nobody: 'nobody',
  silent: 'silent',
  deaf: 'silent',
  not_understood: 'unknown',
  other_version: 'other_version',
}

export type ProbeResult =
  | 'connected'
  | 'older'
  | 'probing'
  | 'busy'
  | 'forbidden'
  | 'absent'
  | 'nobody'
  | 'silent'
  | 'unknown'
  | 'other_version'
  | 'failed'

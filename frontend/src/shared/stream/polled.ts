// The newest values of a unit, requested one after the other, where no socket passes. Fetched when
// that shows: elsewhere it is not needed.
import type { StreamFrame, StreamHeader } from './frame'
import { MISSING } from './frame'

// A value counts as stale after one and a half seconds: a request has to fit in, on a slow
// connection, too.
const PERIOD_MS = 900

export interface Newest {
  t_us: number
  channels: Record<string, number | null>
}

/** What takes the rows; as of LiveStream. */
export interface Fed {
  begin(header: StreamHeader): void
  take(frame: StreamFrame): void
}

/** Feeds `fed` until the returned function is called. `fetchNewest` throws while there is no
    answer; what is no newer than what was there is not passed on, so that its age shows. */
export function poll(fed: Fed, names: string[], fetchNewest: () => Promise<Newest>): () => void {
  let timer: ReturnType<typeof setTimeout> | undefined
  let stopped = false
  let seen_us: number | null = null

  async function turn() {
    const began_ms = performance.now()
    const newest = document.hidden ? null : await fetchNewest().catch(() => null)
    if (stopped) return
    if (newest && newest.t_us !== seen_us) {
      if (seen_us === null) fed.begin(header(names))
      seen_us = newest.t_us
      fed.take(frame(names, newest))
    }
    timer = setTimeout(() => void turn(), PERIOD_MS - (performance.now() - began_ms))
  }
  void turn()
  return () => {
    stopped = true
    clearTimeout(timer)
  }
}

const header = (names: string[]): StreamHeader => ({
  type: 'stream',
  epoch: 0,
  rate_hz: 1,
  period_us: 1e6,
  channels: names.map((name) => ({ name, unit: '', scale: 1 })),
})

const frame = (names: string[], { t_us, channels }: Newest): StreamFrame => ({
  seq: 0,
  lost_rows: 0,
  t0_s: t_us / 1e6,
  rows: 1,
  channels: names.length,
  counts: names.map((name) => channels[name] ?? MISSING),
})

// Conservation of the unit's stream: built = received + lost on the link + dropped by the unit.

export interface LinkHealth {
  built: number
  received: number
  lost: number
  dropped: number
  healthy: boolean
}

/** The server's account of the stream in frames; null before the unit's first count. */
export function healthOf(counters: Record<string, number | null>): LinkHealth | null {
  const built = counters['balance_built'] ?? 0
  if (built === 0) return null
  const received = counters['balance_received'] ?? 0
  const lost = counters['balance_lost'] ?? 0
  const dropped = counters['balance_dropped'] ?? 0
  return { built, received, lost, dropped, healthy: received === built }
}

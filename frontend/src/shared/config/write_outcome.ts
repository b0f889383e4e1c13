// What a failed write means for the unit: only some failures leave no doubt that nothing changed.
import type { Refusal } from '../api/client'

/** moving, conflict, refused, silent: the unit has what it had. changed: it has the change, though
    its answer was lost. unknown: it may have it. differs: it has something else than was meant. */
export type WriteOutcome =
  'moving' | 'conflict' | 'refused' | 'silent' | 'changed' | 'unknown' | 'differs'

const OUTCOMES = { unchanged: 'silent', changed: 'changed', unknown: 'unknown' } as const

const outcomes: Record<string, WriteOutcome> = {
  not_standing_still: 'moving',
  config_changed: 'conflict',
  read_back_differs: 'differs',
  peer_protocol: 'unknown',
  not_connected: 'silent',
  link: 'silent',
  port_absent: 'silent',
  port_vanished: 'silent',
}

/** What became of the change. Unknown where the server itself broke off, or where an answer is
    missing and the server did not find out. */
export function writeOutcome({ code, status, outcome }: Refusal): WriteOutcome {
  if (outcome) return OUTCOMES[outcome]
  return outcomes[code] ?? ([0, 500, 504].includes(status) ? 'unknown' : 'refused')
}

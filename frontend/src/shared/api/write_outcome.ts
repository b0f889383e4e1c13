// What a failed write means for the unit: only some failures leave no doubt that nothing changed.
import type { Refusal } from './client'

/** moving, conflict, refused, silent: the unit has what it had. unknown: it may have the change.
    differs: it has something else than was meant. */
export type WriteOutcome = 'moving' | 'conflict' | 'refused' | 'silent' | 'unknown' | 'differs'

const outcomes: Record<string, WriteOutcome> = {
  not_standing_still: 'moving',
  config_changed: 'conflict',
  read_back_differs: 'differs',
  commit_unanswered: 'unknown',
  no_result: 'unknown',
  peer_protocol: 'unknown',
  no_answer: 'silent',
  not_connected: 'silent',
  link: 'silent',
  port_absent: 'silent',
  port_vanished: 'silent',
}

/** What became of the change. Nobody knows where the server itself broke off. */
export function writeOutcome({ code, status }: Refusal): WriteOutcome {
  return outcomes[code] ?? (status === 0 || status === 500 ? 'unknown' : 'refused')
}

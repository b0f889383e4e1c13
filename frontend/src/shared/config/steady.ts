// The fixed part of a question to the law about a steady state.
import type { WhyRequest } from '../api/types'

/** Long enough for what the law averages to settle. */
export const STEADY = { brake: false, walk_button: false, hold_s: 10 } satisfies Partial<WhyRequest>

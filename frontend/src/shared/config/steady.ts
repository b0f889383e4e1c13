// What somebody asks of the law when he asks about a state and not about a moment of a ride.
import type { WhyRequest } from '../api/types'

/** Held until what the law averages has settled. */
export const STEADY = { brake: false, walk_button: false, hold_s: 10 } satisfies Partial<WhyRequest>

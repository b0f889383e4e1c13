// Which rides can be tried. The server decides; this is so that a list offers no other. The same is
// checked in backend/rides/replay/service.py.
import type { Ride } from '$shared/api/types'

const NEEDED = ['speed_kmh', 'cadence_rpm', 'assist_mode']
const TORQUES = ['rider_torque_raw', 'rider_torque_nm']
const PERIOD_US_MAX = 100_000

/** The channels that the law needs and a ride was recorded without. */
export function missingChannels(ride: Ride): string[] {
  const recorded = ride.channels.filter((channel) => !channel.derived).map(({ name }) => name)
  const missing = NEEDED.filter((name) => !recorded.includes(name))
  return TORQUES.some((name) => recorded.includes(name))
    ? missing
    : [...missing, 'rider_torque_nm']
}

/** Whether the law can be run over a ride. */
export function canBeTried(ride: Ride): boolean {
  const { state, damage, period_us } = ride
  const dense = period_us !== null && period_us <= PERIOD_US_MAX
  return state === 'done' && !damage && dense && missingChannels(ride).length === 0
}

// What a ride is called: its title, else where it came from.
import type { Ride } from '../api/types'
import type { Locale } from './locale.svelte'

export function rideTitle(ride: Ride, locale: Locale): string {
  if (ride.name) return ride.name
  if (ride.state === 'live') return locale.t('ride.live_title')
  return locale.t(ride.origin === 'recorded' ? 'ride.recorded_title' : 'ride.imported_title')
}

// What a ride is called: the name it was given, else the time of day and the place it began at.
import type { Ride } from '../api/types'
import type { Locale } from './locale.svelte'

// From which hour on; `backend/cli/ride.py` says the same.
const PARTS = [
  [22, 'night'],
  [18, 'evening'],
  [14, 'afternoon'],
  [11, 'midday'],
  [5, 'morning'],
  [0, 'night'],
] as const

export function rideTitle(ride: Ride, locale: Locale): string {
  const { t } = locale
  if (ride.name) return ride.name
  if (ride.state === 'live') return t('ride.live_title')
  const hour = hourAt(ride.started_at, ride.place?.zone ?? undefined)
  const [, part] = PARTS.find(([from]) => hour >= from) ?? PARTS[0]
  const kind = ride.place?.is_loop ? 'loop' : 'ride'
  const title = t('ride.title', { part: t(`ride.part_${part}`), kind: t(`ride.kind_${kind}`) })
  const place = ride.place?.name
  return place ? t('ride.title_at', { ride: title, place }) : title
}

/** The hour by the clock of a time zone; by the reader's where there is none, or an unknown one. */
function hourAt(iso: string, timeZone: string | undefined): number {
  const at = new Date(iso)
  try {
    const format = new Intl.DateTimeFormat('en-GB', { hour: '2-digit', hourCycle: 'h23', timeZone })
    return Number(format.format(at))
  } catch {
    return at.getHours()
  }
}

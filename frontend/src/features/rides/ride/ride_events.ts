// What happened on a ride, in words.
import type { RideEvent } from '$shared/api/types'
import type { Locale } from '$shared/i18n/locale.svelte'
import { faultList } from '$shared/device/fault_text'
import { flagNames } from '$shared/stream/flags'
import { words } from './words'

const DAY_S = 86_400

/** A sentence for an event: which faults came or went, which mode was chosen, which mark it is. */
export function eventText(
  event: RideEvent,
  locale: Locale,
  modeName: (mode: number) => string,
): string {
  const say = words(locale)
  if (event.kind === 'assist_mode') {
    return say('event_assist_mode', { mode: modeName(event.value) })
  }
  if (event.kind === 'settings') return say('event_settings')
  if (event.kind === 'mark') return say('event_mark', { number: event.value })
  if (event.kind === 'clock_set') {
    const key = event.value < 0 ? 'clock_set_back' : 'clock_set_forward'
    return say(key, { by: spanText(event.value, locale) })
  }
  const names = faultList(locale, flagNames('fault_flags', event.value))
  return say(`event_${event.kind}`, { names })
}

/** Days and h:mm:ss of a time in ms, whichever way it goes. */
function spanText(ms: number, locale: Locale): string {
  const seconds = Math.round(Math.abs(ms) / 1000)
  const days = Math.floor(seconds / DAY_S)
  const rest = locale.duration(seconds % DAY_S)
  return days > 0 ? words(locale)('days_and', { days: locale.number(days), rest }) : rest
}

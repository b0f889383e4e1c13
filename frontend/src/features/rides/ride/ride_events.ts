// What happened on a ride, in words.
import type { RideEvent } from '$shared/api/types'
import type { Locale } from '$shared/i18n/locale.svelte'
import { flagNames } from '$shared/stream/flags'

/** A sentence for an event: which faults came or went, which mode was chosen, which mark it is. */
export function eventText(
  event: RideEvent,
  { t, lookup }: Locale,
  modeName: (mode: number) => string,
): string {
  if (event.kind === 'assist_mode') {
    return t('ride.event_assist_mode', { mode: modeName(event.value) })
  }
  if (event.kind === 'mark') return t('ride.event_mark', { number: event.value })
  const names = flagNames('fault_flags', event.value).map((name) =>
    lookup(`fault_flag.${name}`, name),
  )
  return t(`ride.event_${event.kind}`, { names: names.join(', ') })
}

// What happened on a ride, in words.
import type { RideEvent } from '$shared/api/types'
import type { Locale } from '$shared/i18n/locale.svelte'
import { faultList } from '$shared/device/fault_text'
import { flagNames } from '$shared/stream/flags'

/** A sentence for an event: which faults came or went, which mode was chosen, which mark it is. */
export function eventText(
  event: RideEvent,
  locale: Locale,
  modeName: (mode: number) => string,
): string {
  const { t } = locale
  if (event.kind === 'assist_mode') {
    return t('ride.event_assist_mode', { mode: modeName(event.value) })
  }
  if (event.kind === 'settings') return t('ride.event_settings')
  if (event.kind === 'mark') return t('ride.event_mark', { number: event.value })
  const names = faultList(locale, flagNames('fault_flags', event.value))
  return t(`ride.event_${event.kind}`, { names })
}

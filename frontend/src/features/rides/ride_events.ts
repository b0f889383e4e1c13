// What happened on a ride, in words.
import { FLAGS } from '$generated/registry'
import type { RideEvent } from '$shared/api/types'
import type { Locale } from '$shared/i18n/locale.svelte'

/** A sentence for an event: which faults came or went, or which mode was chosen. */
export function eventText(event: RideEvent, { t, lookup }: Locale): string {
  if (event.kind === 'assist_mode') return t('ride.event_assist_mode', { mode: event.value })
  const names = Object.entries(FLAGS.fault_flags)
    .filter(([, bit]) => event.value & (1 << bit))
    .map(([name]) => lookup(`fault_flag.${name}`, name))
  return t(`ride.event_${event.kind}`, { names: names.join(', ') })
}

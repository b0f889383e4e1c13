// A sentence for what is doubtful of a ride: both figures, and what may be the reason.
import type { Ride } from '$shared/api/types'
import { channelName } from '$shared/i18n/channel_name'
import type { Locale } from '$shared/i18n/locale.svelte'
import type { Units } from '$shared/units/units.svelte'
import type { Say } from './words'

export type Doubt = Ride['doubts'][number]

export function doubtText(doubt: Doubt, say: Say, locale: Locale, units: Units): string {
  const shown = (value: number) => {
    if (doubt.unit === 's') return locale.duration(value)
    if (doubt.unit === 'm/h') return `${units.text(value, 'm of altitude')}/h`
    if (doubt.unit === '') return locale.number(value)
    return units.text(value, doubt.unit)
  }
  return say(doubt.code, {
    figure: shown(doubt.figure),
    against: shown(doubt.against),
    channel: channelName(doubt.channel ?? '', locale),
    time: locale.duration(doubt.seconds),
  })
}

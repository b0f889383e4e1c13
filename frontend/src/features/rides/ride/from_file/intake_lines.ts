// What of a file is not simply a row or a number of its ride, a line each.
import type { Ride } from '$shared/api/types'
import { channelName } from '$shared/i18n/channel_name'
import type { Locale } from '$shared/i18n/locale.svelte'
import en from '$messages/en/from_file.json'
import type { Say, Key } from './words'

type Intake = NonNullable<Ride['intake']>

export function intakeLines(intake: Intake, say: Say, locale: Locale): string[] {
  const counted: [Key, number][] = [
    ['joined', intake.rows_joined],
    ['spread', intake.rows_spread],
    ['moved', intake.rows_moved],
  ]
  for (const [reason, count] of Object.entries(intake.rows_dropped))
    counted.push([reason in en ? (reason as Key) : 'no_value', count])
  const count = (many: number) => ({ count: locale.number(many) })
  const channel = (name: string) => channelName(name, locale)
  return [
    ...counted.filter(([, many]) => many > 0).map(([key, many]) => say(key, count(many))),
    ...Object.entries(intake.values_dropped).map(([name, many]) =>
      say('values', { ...count(many), channel: channel(name) }),
    ),
    ...Object.entries(intake.restarts).map(([name, many]) =>
      name === 'time'
        ? say('restart_time', count(many))
        : say('restart', { ...count(many), channel: channel(name) }),
    ),
    ...intake.turned.map((name) => say('turned', { channel: channel(name) })),
    ...Object.entries(intake.taken_as).map(([name, value]) => taken(name, value, say, channel)),
    ...Object.entries(intake.fields_unread).map(([field, many]) =>
      say('unread', { ...count(many), field }),
    ),
  ]
}

/** What the file does not say, and was taken as. */
function taken(name: string, value: string, say: Say, channel: (name: string) => string): string {
  if (name === 'start' || name === 'date_order') return say(`taken_${value}` as Key)
  if (name === 'time_zone') return say('taken_time_zone', { value })
  if (name === 'clock') return say('taken_clock', { value })
  if (name === 'rows_per_second') return say('taken_rows_per_second', { value })
  if (value === 'left out') return say('taken_left_out', { column: name })
  const [meaning = '', unit] = value.split(', ')
  if (meaning.includes('_')) {
    const known = unit ? `${channel(meaning)} (${unit})` : channel(meaning)
    return say('taken_channel', { column: name, channel: known })
  }
  return say('taken_unit', { column: name, value })
}

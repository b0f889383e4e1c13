// What of a file is not simply a row or a number of its ride, a line each.
import type { Ride } from '$shared/api/types'
import type { Locale } from '$shared/i18n/locale.svelte'
import en from '$messages/en/ride.json'
import type { Say, Key } from '../words'

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
  return [
    ...counted.filter(([, many]) => many > 0).map(([key, many]) => say(key, count(many))),
    ...Object.entries(intake.values_dropped).map(([name, many]) =>
      say('values', { ...count(many), channel: locale.lookup(`channel.${name}`, name) }),
    ),
    ...Object.entries(intake.taken_as).map(([name, value]) => taken(name, value, say)),
    ...Object.entries(intake.fields_unread).map(([field, many]) =>
      say('unread', { ...count(many), field }),
    ),
  ]
}

/** What the file does not say, and was taken as. */
function taken(name: string, value: string, say: Say): string {
  if (name === 'start') return say(value === 'file_name' ? 'taken_file_name' : 'taken_none')
  if (name === 'time_zone') return say('taken_time_zone', { value })
  if (name === 'clock') return say('taken_clock', { value })
  if (name === 'rows_per_second') return say('taken_rows_per_second', { value })
  return say('taken_unit', { column: name, value })
}

// The words of a ride from a file. They come with its page: the first page need not carry them.
import type { Values } from '$shared/i18n/locale.svelte'
import { pageWords } from '$shared/i18n/page_words.svelte'

export const en = {
  file: 'What the file held',
  whole: 'Every record and every number of the file is in this ride.',
  kept: '{kept} of {read} records are rows of this ride.',
  sport: 'Sport: {sport}',
  joined: '{count} with another of the same time, which they complete',
  spread: '{count} of the same time as others: they stand evenly within it',
  moved: 'The clock went back {count} times; the rows were put in order',
  no_time: '{count} without a time',
  clock_not_set: '{count} from before the clock was set',
  clock_jumped: '{count} with a clock that jumped away',
  no_value: '{count} without any value',
  values: '{count} impossible values of {channel} are left out',
  taken_unit: '{column} is in {value}, as its owner said',
  taken_time_zone: 'Its times are of {value}, as its owner said',
  taken_clock: 'Its times are of {value}: so far they are from its start, which is in UTC',
  taken_rows_per_second: '{value} rows a second',
  taken_file_name: 'Date and time are from the file’s name',
  taken_none: 'The file has no date: the ride stands at the time it was sent',
  unread: '{field} is no single number ({count} records)',
  same_ride: 'The same ride, recorded by another device:',
  devices: 'What recorded it ({count})',
  serial: 'serial number {number}',
  battery: 'battery {state}',
  state_new: 'new',
  state_good: 'good',
  state_ok: 'ok',
  state_low: 'low',
  state_critical: 'critical',
  state_charging: 'charging',
  kind_recorder: 'Recorder',
  kind_bike_power: 'Power meter',
  kind_heart_rate: 'Heart rate',
  kind_bike_speed: 'Speed',
  kind_bike_cadence: 'Cadence',
  kind_bike_speed_cadence: 'Speed and cadence',
  kind_light_electric_vehicle: 'E-bike',
  kind_barometer: 'Barometer',
  kind_gps: 'Positions',
  kind_accelerometer: 'Acceleration',
  kind_environment_sensor: 'Temperature',
  kind_fitness_equipment: 'Trainer',
  kind_bike_light: 'Light',
  kind_bike_radar: 'Radar',
  sport_cycling: 'cycling',
  sport_e_biking: 'e-bike',
  sport_running: 'running',
  sport_walking: 'walking',
  sport_hiking: 'hiking',
  sport_swimming: 'swimming',
  sport_transition: 'transition',
  sport_training: 'training',
  sport_generic: 'not told',
}

export type RideFileKey = keyof typeof en
export type FileSay = (key: RideFileKey, values?: Values) => string

/** A word of the file: ours where there is one, else its own. */
export function told(say: FileSay, of: 'kind' | 'sport' | 'state', word: string): string {
  const key = `${of}_${word.toLowerCase()}`
  return key in en ? say(key as RideFileKey) : word.replaceAll('_', ' ')
}

export const words = await pageWords(en, async () => (await import('./file_words_zh')).zh)

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
}

export type RideFileKey = keyof typeof en
export type FileSay = (key: RideFileKey, values?: Values) => string

export const words = await pageWords(en, async () => (await import('./file_words_zh')).zh)

// The words of the rides since a change. They come with the page.
import type { Values } from '$shared/i18n/locale.svelte'
import { pageWords } from '$shared/i18n/page_words.svelte'

export const en = {
  since: 'Rides since',
  title: 'Since this change',
  before: 'before',
  after: 'since',
  rides: 'Rides',
  distance_km: 'Distance',
  speed_kmh_mean: 'Mean speed while moving',
  motor_wh_per_km: 'Motor work by distance',
  spread: 'least to most of one ride',
  rider_wh_per_km: 'Your work by distance',
  battery_wh_per_km: 'From the battery by distance',
  assist_ratio: "Motor's work over yours",
  more: 'Every ride since took more from the motor for its distance than every ride before.',
  less: 'Every ride since took less from the motor for its distance than every ride before.',
  mixed: 'The rides since and those before overlap: they do not tell that the change did anything.',
  too_few: 'Too few rides to tell: three on either side, with measured motor work, are the least.',
  cannot: 'Other roads, another wind, another day: what moved may be theirs.',
  during: 'Made in the middle of rides that are on neither side: {count}.',
  others: 'Other changes fell within these rides: {count}.',
}

export type SinceKey = keyof typeof en

export type Say = (key: SinceKey, values?: Values) => string

export const sinceWords = await pageWords(en, async () => (await import('./since_words_zh')).zh)

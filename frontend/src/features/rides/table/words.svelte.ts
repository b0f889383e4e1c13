// The words of a table that does not say its units or zone.
import type { Values } from '$shared/i18n/locale.svelte'
import { pageWords } from '$shared/i18n/page_words.svelte'

export const en = {
  title: 'What {name} does not say',
  why: 'Nothing is guessed. What you say here is kept for every file with the same columns.',
  zone: 'Time zone of its times',
  zone_hint: 'A place, such as Europe/Dublin, or UTC.',
  rate: 'Rows a second',
  rate_hint: 'Its rows have no time. Loggers write 1, 5 or 10.',
  column: 'Column',
  becomes: 'Is',
  unit: 'Unit',
  first: 'First rows',
  nothing: 'kept under its own name',
  when: 'time',
  choose: 'choose …',
  unit_of: 'Unit of {column}',
  read: 'Read the file',
  cancel: 'Not now',
  reading: 'Reading …',
}

export type TableKey = keyof typeof en
export type TableSay = (key: TableKey, values?: Values) => string

export const words = await pageWords(en, async () => (await import('./words_zh')).zh)

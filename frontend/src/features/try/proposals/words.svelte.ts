// The words of proposals. They come with the page: the first page need not carry them.
import type { Values } from '$shared/i18n/locale.svelte'
import { pageWords } from '$shared/i18n/page_words.svelte'

export const en = {
  title: 'Find settings for a wish',
  wish: 'Wish',
  more_range: 'More range',
  gentler_start: 'A gentler start',
  flatter_at_the_limit: 'Flatter at the limit',
  by: 'by',
  turn: 'May be turned',
  'knob.ratio': 'ratio of the ridden modes',
  'knob.band': 'band before the cut-off',
  'knob.filter': 'torque filter',
  'knob.torque_rate': 'torque-rate points',
  'knob.cells': 'rules, as a monotone table',
  look: 'Look on this ride',
  cancel: 'Stop looking',
  waiting: 'Waits for another search',
  riding: 'Riding the same road again: {count} times so far',
  proving: 'Checking what was found',
  cancelled: 'Stopped. Nothing was changed.',
  nothing: 'Looks for settings by riding this road again some 300 times. Nothing is written.',
  found: '{count} found in {seconds}; the marked one costs least for what was wished.',
  gains: 'Gains',
  energy: 'Battery by distance',
  duration: 'Time',
  sets: 'Sets',
  band: 'nine of ten {low} – {high}',
  before: 'now {value}',
  marked: 'as wished',
  take: 'Try',
  save: 'Keep',
  taken: '{count} settings are in the draft of Tune. Nothing is in the unit.',
  no_unit: 'To try one, connect the unit: it becomes the draft of Tune.',
  saved: '{name} is in the library.',
  rules: '{count} rules',
  clean: 'Each is certified, and the checks find nothing in it that they do not find now.',
}

export type ProposalKey = keyof typeof en

export type Say = (key: ProposalKey, values?: Values) => string

export const words = await pageWords(en, async () => (await import('./words_zh')).zh)

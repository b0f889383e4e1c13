// The words of the surface. They come with its page: the first page need not carry them.
import type { Values } from '$shared/i18n/locale.svelte'
import { pageWords } from '$shared/i18n/page_words.svelte'

export const en = {
  shown: 'Show',
  shown_asked_nm: 'Requested, torque',
  shown_given_nm: 'Arrives, torque',
  shown_asked_w: 'Requested, power',
  shown_given_w: 'Arrives, power',
  push: 'Your push',
  mode: 'Mode',
  slices: 'Slices',
  torque_summary: '{least} to {most} at the crank, held for long at 60 rpm.',
  no_mode: 'No mode runs by this table, so it comes to no torque.',
  taken: 'Hatched, taken by {limits}.',
  taken_by: '{limit} ({share} % of the map)',
  taken_nothing: 'No limit takes anything.',
  slice_speed: '{name} at {speed}',
  slice_rate: '{name} at torque rate {rate}',
  slice_summary: '{least} to {most}.',
  slice_asked: 'Dashed: requested, up to {most}; hatched: taken by a limit.',
  turn: 'Drag or arrow keys turn it',
}

export type SurfaceKey = keyof typeof en

export type Say = (key: SurfaceKey, values?: Values) => string

export const words = await pageWords(en, async () => (await import('./words_zh')).zh)

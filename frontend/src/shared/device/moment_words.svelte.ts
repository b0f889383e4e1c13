// The words of what a bike did around a fault. They come with the pages that show it.
import type { Values } from '../i18n/locale.svelte'
import { pageWords } from '../i18n/page_words.svelte'

export const en = {
  title: 'What the bike did then',
  rider: 'rider',
  motor: 'motor',
  motor_asked: 'motor, asked for',
  fault: 'fault',
  no_reading: 'no reading',
  no_frame: 'The unit kept no moment of this fault.',
  not_recorded: 'No ride was being recorded, and the live stream of then is gone.',
  in_ride: 'in its ride',
  told_rider: 'The rider pushed {least} to {most} before the fault.',
  told_unread_before: 'There is no reading of the rider before the fault.',
  told_unread: 'No reading of it from {at} s on.',
  told_motor: 'The motor gave {before} before it and {after} at the end.',
  told_motor_unread: 'What the motor gave is not known.',
}

export type MomentKey = keyof typeof en
export type Say = (key: MomentKey, values?: Values) => string

export const momentWords = await pageWords(en, async () => (await import('./moment_words_zh')).zh)

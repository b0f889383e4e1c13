// The words of the proposal of torque-rate points. They come with its dialog.
import { pageWords } from '$shared/i18n/page_words.svelte'

export const en = {
  cancel: 'Cancel',
  rescale_title: 'Torque-rate points that your rides use',
  rescale_note:
    'The time in which your torque rose is divided evenly among the points; the first stays at ' +
    '0. Both tables have these points, and every rule keeps its label.',
  rescale_now: 'Now',
  rescale_then: 'Proposed',
  rescale_time: 'Time',
  rescale_judging: 'Judging the proposal…',
  rescale_clean: 'The checks find nothing that they did not find before.',
  rescale_found: 'The checks find what they did not find before:',
  rescale_take: 'Take it into the draft',
}

export const words = await pageWords(en, async () => (await import('./rescale_words_zh')).zh)

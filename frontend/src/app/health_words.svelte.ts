// The words of a server that cannot keep everything. They come when that happens.
import { pageWords } from '$shared/i18n/page_words.svelte'

export const en = {
  degraded: 'Not everything that is recorded can be saved now.',
  was_degraded: 'Not everything that was recorded is whole.',
}

export type HealthKey = keyof typeof en

export const healthWords = await pageWords(en, async () => (await import('./health_words_zh')).zh)

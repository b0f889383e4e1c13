// What is said of a draft beside how much it changes. They come with what says it.
import { pageWords } from '../i18n/page_words.svelte'

export const en = {
  kept: 'Kept in this browser since {time}.',
  meanwhile: 'Changed in the unit meanwhile, and kept: {count}.',
}

export type DraftKey = keyof typeof en

export const draftWords = await pageWords(en, async () => (await import('./draft_words_zh')).zh)

// The words of a bike in the place of another. They come when that happens.
import { pageWords } from '$shared/i18n/page_words.svelte'

export const en = {
  replaced: 'This is another bike: {name} is where {before} was.',
  edits_kept: 'What was edited for {before} ({count}) is kept, and is there when it comes back.',
}

export type ReplacedKey = keyof typeof en

export const replacedWords = await pageWords(
  en,
  async () => (await import('./replaced_words_zh')).zh,
)

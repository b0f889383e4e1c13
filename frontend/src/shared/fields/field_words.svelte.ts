// What a field says of a number that it cannot read or take. The words come with the fields.
import { pageWords } from '../i18n/page_words.svelte'

export const en = {
  number: 'This is not a number.',
  integer: 'This is not a whole number.',
  integer_within: 'A whole number from {min} to {max}.',
  numbers: 'These are not all numbers. Between two of them goes a space or “;”.',
  within: 'A number from {min} to {max}.',
  at_least: 'A number from {min} on.',
}

export type FieldKey = keyof typeof en

export const fieldWords = await pageWords(en, async () => (await import('./field_words_zh')).zh)

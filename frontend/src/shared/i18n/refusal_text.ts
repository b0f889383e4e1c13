// Why something was refused, in the reader's language, and what became of a change.
import type { Refusal } from '../api/client'
import type { Locale } from './locale.svelte'

/** What the server says, and with a lost answer whether the unit has the change. */
export function refusalText(locale: Locale, refusal: Refusal): string {
  const message = locale.translated('refusal', refusal.code, refusal.message)
  return refusal.outcome ? `${message} ${locale.t(`outcome.${refusal.outcome}`)}` : message
}

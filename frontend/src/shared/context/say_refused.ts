import { Refusal } from '../api/client'
import { refusalText } from '../i18n/refusal_text'
import type { AppContext } from './app_context'

/** Shows why something was refused; any other error is thrown. */
export function sayRefused(app: Pick<AppContext, 'locale' | 'toasts'>, error: unknown): void {
  if (!(error instanceof Refusal)) throw error
  app.toasts.say('bad', refusalText(app.locale, error))
}

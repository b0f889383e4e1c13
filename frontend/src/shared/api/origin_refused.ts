// Why no socket passes, where the server itself refuses it.
import { refusal, type Refusal } from './client'

/** What the server has against whatever names this page as its origin, as a socket's handshake does
    and a plain GET does not; null if nothing. */
export async function originRefused(): Promise<Refusal | null> {
  const answer = await fetch(new URL('healthz', document.baseURI), { method: 'OPTIONS' })
  return answer.status === 403 ? refusal(403, await answer.json()) : null
}

// Where a phone finds this server. Throws Refusal.
import type { components } from '$generated/api'
import { body, type Http } from '$shared/api/client'

export type Addresses = components['schemas']['Addresses']

export const WITH_TLS = 'spindle serve --host 0.0.0.0 --tls own'
// As many pairs as a narrow phone has room for, and browsers have in a line.
const PAIRS = 8

export function addresses(http: Http, signal: AbortSignal): Promise<Addresses> {
  return body(http.GET('/api/v1/server/addresses', { signal }))
}

/** A fingerprint in lines that an eye can compare. */
export function fingerprintLines(sha256: string): string[] {
  const pairs = sha256.split(':')
  const starts = Array.from({ length: Math.ceil(pairs.length / PAIRS) }, (_, line) => line * PAIRS)
  return starts.map((start) => pairs.slice(start, start + PAIRS).join(' '))
}

// The maker's answer to a challenge, as people bring it: pasted, or in a file with more around it.
import type { TokenChallenge } from '../api/types'

/** 8 bytes of expiry and 64 of signature, in hexadecimal. */
const TOKEN_CHARACTERS = 144

/** The token in a text; null when there is none, or more than one. */
export function tokenIn(text: string): string | null {
  const joined = text.replace(/^0x/i, '').replace(/\s+/g, '')
  if (/^[0-9a-f]+$/i.test(joined)) return joined.length === TOKEN_CHARACTERS ? joined : null
  const tokens = (text.match(/[0-9a-f]+/gi) ?? []).filter((w) => w.length === TOKEN_CHARACTERS)
  return tokens.length === 1 ? (tokens[0] ?? null) : null
}

/** What is handed to the maker: the text that `spindle unlock sign` reads. */
export function challengeText(challenge: TokenChallenge): string {
  return JSON.stringify({ challenge }, null, 2) + '\n'
}

/** A name for the file, so that a maker with several of them can distinguish them. */
export function challengeFile(challenge: TokenChallenge): string {
  return `challenge-${challenge.uid}-${challenge.nonce.slice(0, 8)}.json`
}

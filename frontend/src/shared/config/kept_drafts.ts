// Edits that are not in their unit yet, kept in this browser until they are written or discarded:
// a tab's own first, so that two tabs do not take each other's.
import type { Edits } from './config_draft.svelte'

/** base: what the unit had when the first of them was made. */
export interface Kept {
  edits: Edits
  base: Edits
  reason: string
  at_ms: number
}

const PREFIX = 'spindle.draft\n'

/** Null for none. Where the browser keeps nothing, edits live as long as the page. */
export function keep(key: string, kept: Kept | null): void {
  const text = JSON.stringify(kept)
  for (const place of places()) {
    try {
      if (kept) place.setItem(PREFIX + key, text)
      else place.removeItem(PREFIX + key)
    } catch {
      // Full, or forbidden: the edits are on the page.
    }
  }
}

/** Everything that is kept, by key. */
export function allKept(): Map<string, Kept> {
  const found = new Map<string, Kept>()
  for (const place of places().toReversed()) {
    for (const key of Object.keys(place).filter((name) => name.startsWith(PREFIX))) {
      try {
        const kept = JSON.parse(place.getItem(key) ?? '') as Kept
        if (typeof kept.edits !== 'object' || typeof kept.base !== 'object') throw new TypeError()
        found.set(key.slice(PREFIX.length), kept)
      } catch {
        place.removeItem(key)
      }
    }
  }
  return found
}

function places(): Storage[] {
  try {
    return [sessionStorage, localStorage]
  } catch {
    return []
  }
}

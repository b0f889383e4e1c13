// Edits that are not in their unit yet, stored in this browser until they are written or discarded:
// a tab's own first, so that two tabs do not take each other's.
import type { Edits } from './config_draft.svelte'

/** base: what the unit had when the first of them was made. */
export interface StoredDraft {
  edits: Edits
  base: Edits
  reason: string
  at_ms: number
}

const PREFIX = 'spindle.draft\n'

/** Null for none. Where the browser stores nothing, edits live as long as the page. */
export function storeDraft(key: string, stored: StoredDraft | null): void {
  const text = JSON.stringify(stored)
  for (const place of places()) {
    try {
      if (stored) place.setItem(PREFIX + key, text)
      else place.removeItem(PREFIX + key)
    } catch {
      // Full, or forbidden: the edits are on the page.
    }
  }
}

/** All stored drafts, by key. */
export function storedDrafts(): Map<string, StoredDraft> {
  const drafts = new Map<string, StoredDraft>()
  for (const place of places().toReversed()) {
    for (const key of Object.keys(place).filter((name) => name.startsWith(PREFIX))) {
      try {
        const stored = JSON.parse(place.getItem(key) ?? '') as StoredDraft
        const { edits, base } = stored
        if (typeof edits !== 'object' || typeof base !== 'object') throw new TypeError()
        drafts.set(key.slice(PREFIX.length), stored)
      } catch {
        place.removeItem(key)
      }
    }
  }
  return drafts
}

function places(): Storage[] {
  try {
    return [sessionStorage, localStorage]
  } catch {
    return []
  }
}

// Drafts by unit and page, made once by app/main.ts and handed down through Svelte's context.
import { createContext } from 'svelte'
import type { Server } from '../api/server'
import { ConfigDraft, type UnitRef } from './config_draft.svelte'
import { storedDrafts } from './stored_drafts'

/** Each page edits and writes its own draft; it belongs to the unit and not to its connection, and
    this browser stores it until it is written or discarded. */
export class Drafts {
  private readonly byKey = new Map<string, ConfigDraft>()

  constructor(private readonly server: Server) {
    for (const [key, stored] of storedDrafts()) {
      const unit = { id: '', unit_key: key.split('\n')[0] ?? '' }
      this.byKey.set(key, new ConfigDraft(unit, server, key, stored))
    }
  }

  of(unit: UnitRef, page: string): ConfigDraft {
    const key = keyOf(unit.unit_key ?? unit.id, page)
    const draft =
      this.byKey.get(key) ??
      this.beforeItsName(unit, page) ??
      new ConfigDraft(unit, this.server, unit.unit_key ? key : '')
    this.byKey.set(key, draft)
    draft.device_id = unit.id
    return draft
  }

  /** How many values of a unit are edited and not written, on all pages. */
  count(unit_key: string): number {
    const own = [...this.byKey.values()].filter((draft) => draft.unit_key === unit_key)
    return own.reduce((sum, draft) => sum + draft.count, 0)
  }

  /** The draft of a unit without a serial number from before it got a name. */
  private beforeItsName({ unit_key, url }: UnitRef, page: string): ConfigDraft | null {
    const [family, name] = unit_key?.split(':name:') ?? []
    if (!unit_key || name === undefined) return null
    const key = keyOf(`${family}:url:${url}`, page)
    const draft = this.byKey.get(key)
    if (!draft) return null
    this.byKey.delete(key)
    draft.rename(unit_key, keyOf(unit_key, page))
    return draft
  }
}

function keyOf(unit: string, page: string): string {
  return `${unit}\n${page}`
}

export const [useDrafts, provideDrafts] = createContext<Drafts>()

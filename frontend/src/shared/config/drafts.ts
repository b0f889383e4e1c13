// Drafts by unit and page, made once by app/main.ts and handed down through Svelte's context.
import { createContext } from 'svelte'
import type { Server } from '../api/server'
import { ConfigDraft } from './config_draft.svelte'

/** Each page edits and writes its own draft. */
export class Drafts {
  private readonly byKey: Record<string, ConfigDraft> = {}

  constructor(private readonly server: Server) {}

  of(device_id: string, page: string): ConfigDraft {
    const key = `${device_id}\n${page}`
    return (this.byKey[key] ??= new ConfigDraft(device_id, this.server))
  }
}

export const [useDrafts, provideDrafts] = createContext<Drafts>()

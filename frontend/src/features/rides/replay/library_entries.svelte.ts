// What the library has: names at once, values when one is chosen.
import { Refusal } from '$shared/api/client'
import type { Server } from '$shared/api/server'
import type { LibraryRow } from '$shared/api/types'
import type { Settings } from './candidate'

export class LibraryEntries {
  rows = $state.raw<LibraryRow[]>([])
  problem = $state.raw<Refusal | null>(null)
  private loaded = $state.raw<Record<string, Settings>>({})

  constructor(private readonly server: Server) {}

  /** Fetches the names. A library that cannot be had leaves the other candidates. */
  async load(): Promise<void> {
    await this.guarded(async () => {
      this.rows = await this.server.library()
    })
  }

  /** Fetches an entry, once. */
  async fetch(id: string): Promise<void> {
    if (id in this.loaded) return
    await this.guarded(async () => {
      const { parameters } = await this.server.libraryEntry(id)
      const values = Object.entries(parameters).map(([name, { value }]) => [name, value])
      this.loaded = { ...this.loaded, [id]: Object.fromEntries(values) as Settings }
    })
  }

  /** The settings of an entry that was fetched; null until then. */
  settings(id: string | null): Settings | null {
    return (id !== null && this.loaded[id]) || null
  }

  private async guarded(action: () => Promise<void>): Promise<void> {
    this.problem = null
    try {
      await action()
    } catch (error) {
      if (!(error instanceof Refusal)) throw error
      this.problem = error
    }
  }
}

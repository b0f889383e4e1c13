// The tables of the library: their names at once, their values when one is chosen.
import { Refusal } from '$shared/api/client'
import type { Server } from '$shared/api/server'
import type { FuzzyTable, LibraryRow } from '$shared/api/types'
import { tableFrom } from '$shared/config/two_tables'

export class LibraryTables {
  rows = $state.raw<LibraryRow[]>([])
  trouble = $state.raw<Refusal | null>(null)
  private tables = $state.raw<Record<string, FuzzyTable | null>>({})

  constructor(private readonly server: Server) {}

  /** Fetches the names. A library that cannot be had leaves the other candidates. */
  async load(): Promise<void> {
    await this.noting(async () => {
      this.rows = (await this.server.library()).filter((row) => row.kind === 'table')
    })
  }

  /** Fetches a table, once. */
  async fetch(id: string): Promise<void> {
    if (id in this.tables) return
    await this.noting(async () => {
      const { parameters } = await this.server.libraryEntry(id)
      const table = tableFrom((name) => parameters[name]?.value, 'first')
      this.tables = { ...this.tables, [id]: table }
    })
  }

  /** A table that was fetched; null until then. */
  table(id: string | null): FuzzyTable | null {
    return (id !== null && this.tables[id]) || null
  }

  private async noting(ask: () => Promise<void>): Promise<void> {
    this.trouble = null
    try {
      await ask()
    } catch (error) {
      if (!(error instanceof Refusal)) throw error
      this.trouble = error
    }
  }
}

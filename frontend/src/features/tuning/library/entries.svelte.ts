// The entries of the library as the page has them: listed, measured one after the other, changed.
import { Refusal } from '$shared/api/client'
import type { Server } from '$shared/api/server'
import type {
  Feel,
  LibraryDocument,
  LibraryEntry,
  LibraryRow,
  ReadFis,
} from '$shared/api/types'

export class Entries {
  rows = $state.raw<LibraryRow[] | null>(null)
  problem = $state.raw<Refusal | null>(null)
  /** By ETag, so that a changed entry is measured anew; null for one that cannot be. */
  feels = $state.raw<Record<string, Feel | null>>({})
  private measuring = false

  constructor(private readonly server: Server) {}

  async load(): Promise<void> {
    try {
      this.rows = await this.server.library()
      this.problem = null
    } catch (error) {
      if (!(error instanceof Refusal)) throw error
      this.problem = error
    }
    void this.measure()
  }

  /** One at a time: measuring takes the server an eighth of a second. */
  private async measure(): Promise<void> {
    if (this.measuring) return
    this.measuring = true
    try {
      for (;;) {
        const row = this.rows?.find(({ etag }) => !(etag in this.feels))
        if (!row) return
        const feel = await this.server.libraryFeel(row.id).catch(() => null)
        this.feels = { ...this.feels, [row.etag]: feel }
      }
    } finally {
      this.measuring = false
    }
  }

  /** Saves a document. Throws Refusal. */
  async add(document: LibraryDocument): Promise<LibraryRow> {
    const row = await this.server.addToLibrary(document)
    await this.load()
    return row
  }

  /** Gives an own entry another content; what it was stays among its versions. Throws Refusal. */
  async replace(row: LibraryRow, document: LibraryDocument): Promise<void> {
    await this.server.changeInLibrary(row.id, document, row.etag)
    await this.load()
  }

  /** What an own entry was, newest first. Throws Refusal. */
  versions(row: LibraryRow): Promise<LibraryRow[]> {
    return this.server.libraryVersions(row.id)
  }

  /** Makes an own entry what it once was, as a version of its own. Throws Refusal. */
  async backTo(row: LibraryRow, version: number): Promise<void> {
    await this.replace(row, await this.server.libraryEntry(row.id, version))
  }

  /** Throws Refusal. */
  async remove(row: LibraryRow): Promise<LibraryRow> {
    const gone = await this.server.removeFromLibrary(row.id, row.etag)
    await this.load()
    return gone
  }

  /** Brings a deleted entry back as it was. Throws Refusal. */
  async bringBack(gone: LibraryRow): Promise<void> {
    const was = await this.server.libraryEntry(gone.id, gone.version ?? undefined)
    await this.server.changeInLibrary(gone.id, was, gone.etag)
    await this.load()
  }

  /** Saves what a file holds; with a .fis file what was read of it. Throws Refusal, SyntaxError. */
  async take(file: File): Promise<[LibraryRow, ReadFis | null]> {
    const text = await file.text()
    if (!/\.fis$/i.test(file.name)) {
      return [await this.add(JSON.parse(text) as LibraryEntry), null]
    }
    const read = await this.server.readFis(text, file.name.replace(/\.fis$/i, ''))
    return [await this.add(read.document), read]
  }
}

// What can be tried on a ride, and what the server is asked for it.
import type { FuzzyTable, ReplayRequest } from '$shared/api/types'
import type { ConfigDraft } from '$shared/config/config_draft.svelte'
import {
  modesFrom,
  modesOf,
  tableFrom,
  tableOf,
  type Read,
  type TableName,
} from '$shared/config/two_tables'

/** What is edited in Tune, what the unit has, or the ride's own configuration once more. */
export const OWN = ['draft', 'unit', 'ride'] as const
const LIBRARY = 'library:'
/** One of those, or a table of the library by its id. */
export type Candidate = (typeof OWN)[number] | `${typeof LIBRARY}${string}`

export function ofLibrary(id: string): Candidate {
  return `${LIBRARY}${id}`
}

/** The id of a table of the library; null for another candidate. */
export function libraryId(candidate: Candidate): string | null {
  return candidate.startsWith(LIBRARY) ? candidate.slice(LIBRARY.length) : null
}

/** The candidate that an address names; what is edited where it names none. */
export function candidateIn(query: URLSearchParams): Candidate {
  const named = query.get('with') ?? ''
  if (named.startsWith(LIBRARY)) return named as Candidate
  return OWN.find((name) => name === named) ?? 'draft'
}

/** Whether a unit's tables are known, so that its candidates can be tried. */
export function hasTables(draft: ConfigDraft | null): draft is ConfigDraft {
  return draft !== null && draft.loaded && draft.parameter('fuzzy_rules') !== undefined
}

/** The question for a candidate; null while a value of it is unknown or impossible. A table of the
    library stands in for the first one; the ride's own second one and modes stay. */
export function questionOf(
  candidate: Candidate,
  draft: ConfigDraft | null,
  in_library: FuzzyTable | null,
): ReplayRequest | null {
  const unchanged: ReplayRequest = {
    mode: 'open_loop',
    fuzzy_table: null,
    second_table: null,
    assist_modes: null,
  }
  if (candidate === 'ride') return unchanged
  if (libraryId(candidate) !== null) return in_library && { ...unchanged, fuzzy_table: in_library }
  if (!hasTables(draft)) return null
  const base: Read = (name) => draft.base(name)
  const edited = candidate === 'draft'
  const table = (which: TableName) => (edited ? tableOf(draft, which) : tableFrom(base, which))
  const fuzzy_table = table('first')
  const second_table = table('second')
  const assist_modes = edited ? modesOf(draft) : modesFrom(base)
  // A unit may have one table only, or modes that this Spindle does not know.
  const lacks = (name: string, found: object | null) => !found && draft.parameter(name)
  if (!fuzzy_table || lacks('second_rules', second_table)) return null
  if (lacks('mode_laws', assist_modes)) return null
  return { mode: 'open_loop', fuzzy_table, second_table, assist_modes }
}

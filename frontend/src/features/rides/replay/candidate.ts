// What can be tried on a ride, and the settings that it is ridden with.
import type { ConfigDraft, Edits } from '$shared/config/config_draft.svelte'
import { faultsOf } from '$shared/config/limits'

/** What takes the place of a ride's own settings, by registry name; sensor and drivetrain stay. */
export type Settings = Edits

/** What is edited in Tune, what the unit has, or the ride's own configuration once more. */
export const OWN = ['draft', 'unit', 'ride'] as const
const LIBRARY = 'library:'
/** One of those, or an entry of the library by its id. */
export type Candidate = (typeof OWN)[number] | `${typeof LIBRARY}${string}`

export function ofLibrary(id: string): Candidate {
  return `${LIBRARY}${id}`
}

/** The id of an entry of the library; null for another candidate. */
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

/** The settings of a candidate, all of them: what else was edited counts as well. Null while one is
    unknown or impossible. Those of a library's table are the first table's alone. */
export function settingsOf(
  candidate: Candidate,
  draft: ConfigDraft | null,
  in_library: Settings | null,
): Settings | null {
  if (candidate === 'ride') return {}
  if (libraryId(candidate) !== null) return in_library
  if (!hasTables(draft)) return null
  const edited = candidate === 'draft'
  if (edited && draft.changes.some((c) => faultsOf(c.parameter, c.value).length > 0)) return null
  const entries = draft.parameters.map(
    ({ name }) => [name, edited ? draft.value(name) : draft.base(name)] as const,
  )
  return Object.fromEntries(entries.filter(([, value]) => value !== undefined)) as Settings
}

/** A mass of rider and bike that a twin can have; null for another. */
export function massOf(mass_kg: number | null): number | null {
  return mass_kg !== null && mass_kg >= 30 && mass_kg <= 400 ? mass_kg : null
}

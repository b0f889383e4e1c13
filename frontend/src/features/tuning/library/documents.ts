// Between the draft of a unit and a document of the library: what is saved, and what is opened.
import type { ComparedSide, LibraryDocument, Parameter, ParameterValue } from '$shared/api/types'
import type { ConfigDraft } from '$shared/config/config_draft.svelte'
import { PARAMETERS_OF, tableOf, type TableName } from '$shared/config/two_tables'

/** What of the draft is saved: one of its tables, or all of it. */
export type SavedPart = TableName | 'configuration'

/** The draft as a document; only what its unit has is in it, and nothing that stays with a unit.
    A table is saved under the names of the first one, whichever of the two it was. */
export function documentOf(draft: ConfigDraft, name: string, what: SavedPart): LibraryDocument {
  const is_configuration = what === 'configuration'
  const from = Object.entries(PARAMETERS_OF[is_configuration ? 'first' : what])
  const to: Record<string, string> = PARAMETERS_OF.first
  const called = new Map(from.map(([role, own]) => [own, to[role] ?? own]))
  const isSaved = (parameter: Parameter) =>
    is_configuration ? !parameter.of_the_unit : called.has(parameter.name)
  const parameters = draft.parameters.filter(isSaved).flatMap(({ name, unit }) => {
    const value = draft.value(name)
    const entry = { value: value as ParameterValue, unit, comment: '' }
    return value === undefined ? [] : [[called.get(name) ?? name, entry] as const]
  })
  const kind = is_configuration ? 'configuration' : 'table'
  return {
    format: `spindle-${kind}`,
    version: 1,
    name,
    comment: '',
    family: 'ebl',
    parameters: Object.fromEntries(parameters),
  }
}

/** Puts values into the draft, taken back together; what only the factory may change and what was
    measured on one bike alone stay as they are. Nothing is written. Gives the names of what differs
    and was left out. */
export function openIn(draft: ConfigDraft, values: Record<string, ParameterValue>): string[] {
  const left_out: string[] = []
  for (const [name, value] of Object.entries(values)) {
    const parameter = draft.parameter(name)
    if (!parameter || parameter.access === 'factory') continue
    if (!parameter.of_the_unit) draft.set(name, value, 'library')
    else if (JSON.stringify(value) !== JSON.stringify(draft.base(name))) left_out.push(name)
  }
  return left_out
}

/** The sides of a comparison by the word that stands for them in the address. */
export function sideOf(
  word: string,
  draft: ConfigDraft | null,
  device_id: string | null,
): ComparedSide | null {
  if (word === '') return null
  if (word === 'draft') {
    const fuzzy_table = draft && tableOf(draft, 'first')
    return fuzzy_table ? { fuzzy_table } : null
  }
  const revision = /^revision-(\d+)$/.exec(word)
  if (word === 'unit' || revision) {
    if (!device_id) return null
    return revision ? { device: device_id, revision: Number(revision[1]) } : { device: device_id }
  }
  return { library: word }
}

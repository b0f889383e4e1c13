// The unit's two fuzzy tables: their parameters, the modes that use them, and what else the linter
// is told so that it judges a table as the bike runs it.
import type { AssistModes, Limits, LintRequest } from '$shared/api/types'
import type { ConfigDraft, Edits } from '$shared/config/config_draft.svelte'
import { faultsOf } from '$shared/config/limits'

export const TABLES = ['first', 'second'] as const
export type TableName = (typeof TABLES)[number]

const first = {
  name: 'fuzzy_table_name',
  inference: 'fuzzy_inference',
  speeds: 'fuzzy_speed_points_kmh',
  rates: 'fuzzy_torque_rate_points',
  gains: 'fuzzy_gain_points',
  rules: 'fuzzy_rules',
}
export type TableParameters = typeof first

/** The second table shares the speeds and rates of the first. */
export const PARAMETERS_OF: Record<TableName, TableParameters> = {
  first,
  second: {
    ...first,
    name: 'second_table_name',
    inference: 'second_inference',
    gains: 'second_gain_points',
    rules: 'second_rules',
  },
}

/** Whether one of these parameters is absent or has a value the unit refuses. */
export function impossible(draft: ConfigDraft, names: string[]): boolean {
  return names.some((name) => {
    const [parameter, value] = [draft.parameter(name), draft.value(name)]
    return !parameter || value === undefined || faultsOf(parameter, value).length > 0
  })
}

/** The table that alone has one of these parameters; null if none of them is of one table only. */
export function tableWith(names: string[]): TableName | null {
  const own = (which: TableName, other: TableName) =>
    Object.values(PARAMETERS_OF[which]).some(
      (name) => names.includes(name) && !Object.values(PARAMETERS_OF[other]).includes(name),
    )
  return own('first', 'second') ? 'first' : own('second', 'first') ? 'second' : null
}

/** Whether a table has edits of its own. */
export function isChanged(draft: ConfigDraft, which: TableName): boolean {
  const changed = draft.changes.map((change) => change.parameter.name)
  return changed.some((name) => tableWith([name]) === which)
}

type Read = (name: string) => Edits[string] | undefined

/** Which table a mode slot runs by; null if its law has none, or nobody knows. */
export function tableOfMode(read: Read, slot: number): TableName | null {
  const [laws, tables] = [read('mode_laws') as string[], read('mode_tables') as number[]]
  if (laws?.[slot] !== 'fuzzy') return null
  return TABLES[tables?.[slot] ?? -1] ?? null
}

/** The names of the modes that run by a table, as the draft has them. */
export function modesWith(draft: ConfigDraft, which: TableName): string[] {
  const names = (draft.value('mode_names') ?? []) as string[]
  return names.flatMap((name, slot) =>
    tableOfMode((parameter) => draft.value(parameter), slot) === which ? [name || `${slot}`] : [],
  )
}

/** What a table is judged with; what has an impossible value is left out. */
export function surroundings(draft: ConfigDraft): Omit<LintRequest, 'fuzzy_table' | 'table'> {
  const names = (group: string) => draft.group(group).map((parameter) => parameter.name)
  const limits = [...names('limits'), ...names('market')]
  const modes_possible = !impossible(draft, names('assist'))
  const gear_known = !impossible(draft, ['gear_ratio'])
  return {
    assist_modes: modes_possible ? modesOf(draft) : null,
    limits: impossible(draft, limits)
      ? null
      : (Object.fromEntries(limits.map((name) => [name, draft.value(name)])) as unknown as Limits),
    taper_speeds_kmh: modes_possible
      ? [
          draft.value('fixed_taper_start_kmh') as number,
          draft.value('fixed_taper_end_kmh') as number,
        ]
      : null,
    gear_ratio: gear_known ? (draft.value('gear_ratio') as number) : null,
  }
}

function modesOf(draft: ConfigDraft): AssistModes {
  const at = (name: string, slot: number) => (draft.value(name) as (number | string)[])[slot]
  const modes = [0, 1, 2, 3, 4].map((slot) => ({
    name: String(at('mode_names', slot)),
    law: at('mode_laws', slot),
    ratio: Number(at('mode_ratios', slot)),
    taper: at('mode_tapers', slot),
    table: TABLES[Number(at('mode_tables', slot))],
    ramp_up_nm_per_s: Number(at('mode_ramp_up_nm_per_s', slot)),
    ramp_down_nm_per_s: Number(at('mode_ramp_down_nm_per_s', slot)),
    torque_pct: Number(at('mode_torque_pct', slot)),
  }))
  return { modes, mode_at_start: draft.value('assist_mode_at_start') } as AssistModes
}

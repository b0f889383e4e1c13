// The unit's two fuzzy tables: between its parameters and what the server's law takes, the modes
// that use them, and what else the linter gets so that it judges a table as the bike runs it.
import type { AssistModes, FuzzyTable, Limits, LintRequest } from '../api/types'
import type { ConfigDraft, Edits } from './config_draft.svelte'
import { faultsOf } from './limits'

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

/** The value of a parameter: what the unit has, or what an edit would make of it. */
export type Read = (name: string) => Edits[string] | undefined

const MODE_PARAMETERS = [
  'mode_names',
  'mode_laws',
  'mode_ratios',
  'mode_tapers',
  'mode_tables',
  'mode_ramp_up_nm_per_s',
  'mode_ramp_down_nm_per_s',
  'mode_torque_pct',
  'assist_mode_at_start',
]

/** One of two tables as the law takes it; null where a parameter of it is unknown. */
export function tableFrom(read: Read, which: TableName): FuzzyTable | null {
  const names = PARAMETERS_OF[which]
  if (Object.values(names).some((name) => read(name) === undefined)) return null
  return {
    name: String(read(names.name)),
    inference: read(names.inference) as FuzzyTable['inference'],
    speed_points_kmh: read(names.speeds) as number[],
    torque_rate_points: read(names.rates) as number[],
    gain_points: read(names.gains) as number[],
    rules: read(names.rules) as FuzzyTable['rules'],
  }
}

/** One of the draft's tables, or null while a value of it is impossible. */
export function tableOf(draft: ConfigDraft, which: TableName): FuzzyTable | null {
  if (!draft.loaded || impossible(draft, Object.values(PARAMETERS_OF[which]))) return null
  return tableFrom((name) => draft.value(name), which)
}

/** The five modes as the law takes them; null where a parameter of them is unknown. */
export function modesFrom(read: Read): AssistModes | null {
  if (MODE_PARAMETERS.some((name) => read(name) === undefined)) return null
  const at = (name: string, slot: number) => (read(name) as (number | string)[])[slot]
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
  return { modes, mode_at_start: read('assist_mode_at_start') } as AssistModes
}

/** The draft's modes, or null where it has none or a value of them is impossible. */
export function modesOf(draft: ConfigDraft): AssistModes | null {
  if (!draft.loaded || impossible(draft, MODE_PARAMETERS)) return null
  return modesFrom((name) => draft.value(name))
}

/** Whether one of these parameters is absent or has a value the unit refuses. */
export function impossible(draft: ConfigDraft, names: string[]): boolean {
  return names.some((name) => {
    const [parameter, value] = [draft.parameter(name), draft.value(name)]
    return !parameter || value === undefined || faultsOf(parameter, value).length > 0
  })
}

/** The complete configuration as edited; null while a value of it is impossible. */
export function completeConfig(draft: ConfigDraft): Edits | null {
  if (!draft.loaded || impossible(draft, draft.parameters.map(({ name }) => name))) return null
  return draft.values
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

/** Which table a mode slot runs by; null if its law has none, or it is unknown. */
export function tableOfMode(read: Read, slot: number): TableName | null {
  const [laws, tables] = [read('mode_laws') as string[], read('mode_tables') as number[]]
  if (laws?.[slot] !== 'fuzzy') return null
  return TABLES[tables?.[slot] ?? -1] ?? null
}

/** The modes that run by a table, as the draft has them. */
export function slotsWith(draft: ConfigDraft, which: TableName): { slot: number; name: string }[] {
  const names = (draft.value('mode_names') ?? []) as string[]
  return names.flatMap((name, slot) =>
    tableOfMode((parameter) => draft.value(parameter), slot) === which
      ? [{ slot, name: name || `${slot}` }]
      : [],
  )
}

/** Their names. */
export function modesWith(draft: ConfigDraft, which: TableName): string[] {
  return slotsWith(draft, which).map(({ name }) => name)
}

/** What a table is judged with; what has an impossible value is left out. */
export function surroundings(draft: ConfigDraft): Omit<LintRequest, 'fuzzy_table' | 'table'> {
  const names = (group: string) => draft.group(group).map((parameter) => parameter.name)
  const limits = [...names('limits'), ...names('market')]
  const modes_possible = !impossible(draft, names('assist'))
  const has_gear = !impossible(draft, ['gear_ratio'])
  return {
    assist_modes: modes_possible ? modesFrom((name) => draft.value(name)) : null,
    limits: impossible(draft, limits)
      ? null
      : (Object.fromEntries(limits.map((name) => [name, draft.value(name)])) as unknown as Limits),
    taper_speeds_kmh: modes_possible
      ? [
          draft.value('fixed_taper_start_kmh') as number,
          draft.value('fixed_taper_end_kmh') as number,
        ]
      : null,
    gear_ratio: has_gear ? (draft.value('gear_ratio') as number) : null,
  }
}

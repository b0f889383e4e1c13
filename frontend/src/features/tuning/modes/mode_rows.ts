// The rows of the matrix of modes: which setting a law has, what it would become in the next mode.
import type { ParameterValue } from '$shared/api/types'
import type { ConfigDraft } from '$shared/config/config_draft.svelte'
import type { Term } from '$shared/context/help.svelte'

export const SLOTS = [0, 1, 2, 3, 4] as const

/** has: whether a mode with this law has the setting. term: where help explains it. */
export interface ModeRow {
  name: string
  has: (law: string) => boolean
  term?: Term
}
const assists = (law: string) => law !== 'off'

export const MODE_ROWS = [
  {
    group: 'asks',
    rows: [
      { name: 'mode_laws', has: () => true, term: 'fuzzy_law' },
      { name: 'mode_ratios', has: assists, term: 'assist_ratio' },
      { name: 'mode_tables', has: (law) => law === 'fuzzy' },
      { name: 'mode_tapers', has: (law) => law === 'fixed', term: 'taper' },
    ],
  },
  {
    group: 'answers',
    rows: [
      { name: 'mode_ramp_up_nm_per_s', has: assists, term: 'ramps' },
      { name: 'mode_ramp_down_nm_per_s', has: assists, term: 'ramps' },
    ],
  },
  { group: 'uses', rows: [{ name: 'mode_torque_pct', has: assists }] },
] as const satisfies { group: string; rows: ModeRow[] }[]

const NAMES = MODE_ROWS.flatMap(({ rows }) => rows.map(({ name }) => name as string))

/** What the matrix shows; the rest of the modes' group stands as a form. */
export const IN_MATRIX = [...NAMES, 'mode_names', 'assist_mode_at_start']

type Elements = (number | string)[]

/** The value of a setting in a mode. */
export function cell(draft: ConfigDraft, name: string, slot: number): number | string | undefined {
  return (draft.value(name) as Elements | undefined)?.[slot]
}

export function isChangedAt(draft: ConfigDraft, name: string, slot: number): boolean {
  return cell(draft, name, slot) !== (draft.base(name) as Elements | undefined)?.[slot]
}

/** Whether a mode, as the draft has it, has a setting. */
export function hasSetting(draft: ConfigDraft, row: ModeRow, slot: number): boolean {
  return row.has(String(cell(draft, 'mode_laws', slot)))
}

export function setCell(
  draft: ConfigDraft,
  name: string,
  slot: number,
  value: number | string,
): void {
  const next = (draft.value(name) as Elements).with(slot, value)
  draft.set(name, next as ParameterValue, `${name}/${slot}`)
}

/** Copies a setting to the next mode on the right that has it; its slot, or null without one. */
export function copyRight(draft: ConfigDraft, row: ModeRow, slot: number): number | null {
  const value = cell(draft, row.name, slot)
  const to = SLOTS.find((other) => other > slot && hasSetting(draft, row, other))
  if (to === undefined || value === undefined || !hasSetting(draft, row, slot)) return null
  setCell(draft, row.name, to, value)
  return to
}

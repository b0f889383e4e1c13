// Which rules fire now, computed by the unit's own law with the table that the ridden mode uses.
import type { AssistModes, FuzzyTable, WhyRequest } from '$shared/api/types'
import { STEADY } from '$shared/config/steady'
import { modesFrom, tableFrom, type Read } from '$shared/config/two_tables'

const RECENT_S = 1

/** What of a configuration decides which rules fire. */
export interface Tables {
  modes: AssistModes
  first: FuzzyTable
  second: FuzzyTable | null
}

/** Null where a parameter of it is unknown. */
export function tablesFrom(read: Read): Tables | null {
  const [modes, first] = [modesFrom(read), tableFrom(read, 'first')]
  return modes && first ? { modes, first, second: tableFrom(read, 'second') } : null
}

export interface Channels {
  times: readonly number[]
  column: (channel: string) => (number | null)[] | null
}

/** The newest moment, a second ago at most, at which torque rose: only then is the table used, and
    every stroke falls as long as it rises. Null for none. */
export function moment(rows: Channels): Record<string, number> | null {
  const { times } = rows
  const names = ['speed_kmh', 'torque_rate', 'rider_torque_filtered_nm', 'cadence_rpm'] as const
  const columns = [...names, 'assist_mode'].map((name) => [name, rows.column(name)] as const)
  const rates = rows.column('torque_rate')
  const oldest_s = (times[times.length - 1] ?? 0) - RECENT_S
  for (let row = times.length - 1; row >= 0 && (times[row] ?? 0) > oldest_s; row--) {
    if ((rates?.[row] ?? -1) < 0) continue
    const entries = columns.map(([name, values]) => [name, values?.[row] ?? null] as const)
    if (entries.every(([, value]) => value !== null)) {
      return Object.fromEntries(entries) as Record<string, number>
    }
  }
  return null
}

export function questionOf(tables: Tables, at: Record<string, number>): WhyRequest {
  const least = (name: string) => Math.max(0, at[name] ?? 0)
  return {
    speed_kmh: least('speed_kmh'),
    torque_rate: least('torque_rate'),
    rider_torque_nm: least('rider_torque_filtered_nm'),
    cadence_rpm: least('cadence_rpm'),
    mode: at['assist_mode'] ?? null,
    ...STEADY,
    fuzzy_table: tables.first,
    second_table: tables.second,
    assist_modes: tables.modes,
  }
}

// What the linter finds in modes and limits, apart from what it finds in a table.
import type { LintReport, LintRequest } from '../api/types'
import type { ConfigDraft } from '../config/config_draft.svelte'
import { modesWith, surroundings, tableOf, TABLES, type TableName } from '../config/two_tables'

/** The question to the linter about one of the draft's tables; null while a value is impossible. */
export function lintQuestion(draft: ConfigDraft, table: TableName): LintRequest | null {
  const fuzzy_table = tableOf(draft, table)
  return fuzzy_table && { fuzzy_table, table, ...surroundings(draft) }
}

/** The questions that together judge every mode: one for each table in use, at least one. */
export function modeQuestions(draft: ConfigDraft): LintRequest[] {
  const used = TABLES.filter((table) => modesWith(draft, table).length > 0)
  return (used.length > 0 ? used : ['first' as const]).flatMap(
    (table) => lintQuestion(draft, table) ?? [],
  )
}

/** Each finding about a mode, a limit or the market once, however many tables it was found with. */
export function modeFindings(reports: readonly LintReport[]): LintReport {
  const only = (kind: keyof LintReport) => {
    const findings = reports
      .flatMap((report) => report[kind])
      .filter(({ where }) => /^(modes\[\d+\].*|(?!modes$)[a-z_]+)$/.test(where ?? ''))
    return [...new Map(findings.map((one) => [`${one.code} ${one.where}`, one])).values()]
  }
  return { errors: only('errors'), warnings: only('warnings'), notes: only('notes') }
}

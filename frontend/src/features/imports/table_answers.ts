// What an owner says of a table, as far as it is said.
import type { TableQuestion } from '$shared/api/types'

export interface AnswerDraft {
  zone: string
  /** By the column's name; '' until it is chosen. */
  units: Record<string, string>
  rate: number | null
}

/** What was said before, and the rider's own zone; a unit is never chosen for him. */
export function answered(question: TableQuestion, here: string): AnswerDraft {
  const before = question.answer
  const with_units = question.columns.filter(({ units }) => units.length > 0)
  const units = with_units.map(({ name, units }) => {
    const unit = before?.units[name] ?? ''
    return [name, units.includes(unit) ? unit : ''] as const
  })
  return {
    zone: before?.time_zone ?? here,
    units: Object.fromEntries(units),
    rate: before?.rows_per_second ?? null,
  }
}

/** Whether everything that is asked is said. */
export function isComplete(question: TableQuestion, draft: AnswerDraft): boolean {
  return (
    (!question.time_zone || draft.zone.trim() !== '') &&
    (!question.rows_per_second || (draft.rate ?? 0) > 0) &&
    question.columns.every(
      ({ name, units }) => units.length === 0 || units.includes(draft.units[name] ?? ''),
    )
  )
}

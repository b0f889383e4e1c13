// An owner's answers about a table, as far as given.
import type { TableQuestion } from '$shared/api/types'

export interface AnswerDraft {
  zone: string
  /** By the column's name; '' until it is chosen. */
  units: Record<string, string>
  rate: number | null
}

/** The earlier answers, and the rider's own zone; a unit is never chosen for the rider. */
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

/** Whether every question is answered. */
export function isComplete(question: TableQuestion, draft: AnswerDraft): boolean {
  return (
    (!question.time_zone || draft.zone.trim() !== '') &&
    (!question.rows_per_second || (draft.rate ?? 0) > 0) &&
    question.columns.every(
      ({ name, units }) => units.length === 0 || units.includes(draft.units[name] ?? ''),
    )
  )
}

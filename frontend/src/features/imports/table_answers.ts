// An owner's answers about a table, as far as given.
import type { TableAnswerRequest, TableQuestion } from '$shared/api/types'

type Column = TableQuestion['columns'][number]
export type DateOrder = 'day_first' | 'month_first'
export const LEFT_OUT = ''
export const TIME = 'time'

export interface AnswerDraft {
  zone: string
  rate: number | null
  order: DateOrder | null
  /** What a column is, by its name; null for what it is now. */
  channels: Record<string, string | null>
  /** By the column's name; '' until it is chosen. */
  units: Record<string, string>
  /** Whether other files with this header are read again by it. */
  read_again: boolean
}

export const EMPTY_DRAFT: AnswerDraft = {
  zone: '',
  rate: null,
  order: null,
  channels: {},
  units: {},
  read_again: false,
}

/** The earlier answers, and the rider's own zone; nothing else is chosen for the rider. */
export function answered(question: TableQuestion, here: string): AnswerDraft {
  const before = question.answer
  const of = <Value>(value: (column: Column) => Value) =>
    Object.fromEntries(question.columns.map((column) => [column.name, value(column)] as const))
  return {
    zone: before?.time_zone ?? here,
    rate: before?.rows_per_second ?? null,
    order: before?.date_order ?? null,
    channels: of(() => null),
    units: of(({ name, units }) => {
      const unit = before?.units[name] ?? ''
      return units.includes(unit) ? unit : ''
    }),
    read_again: false,
  }
}

/** In which units numbers may be of what a column is said to be. */
const unitsOf = ({ offered_channels }: TableQuestion, channel: string | null) =>
  offered_channels.find(({ name }) => name === channel)?.units ?? []

/** The units of which one must be chosen for a column, as what the draft says it is. */
export function unitChoices(
  question: TableQuestion,
  column: Column,
  { channels }: AnswerDraft,
): string[] {
  const stated = channels[column.name] ?? column.channel
  if (stated === column.channel) return column.units
  const units = unitsOf(question, stated)
  return units.includes(column.unit ?? '') ? [] : units
}

/** Whether every question is answered. */
export function isComplete(question: TableQuestion, draft: AnswerDraft): boolean {
  return (
    (!question.time_zone || draft.zone.trim() !== '') &&
    (!question.rows_per_second || (draft.rate ?? 0) > 0) &&
    (!question.date_order || draft.order !== null) &&
    question.columns.every((column) => {
      const units = unitChoices(question, column, draft)
      const stated = column.channels.length === 0 || draft.channels[column.name] !== null
      return stated && (units.length === 0 || units.includes(draft.units[column.name] ?? ''))
    })
  )
}

/** What is sent: the draft, and of the earlier answers what it leaves alone. */
export function asRequest(question: TableQuestion, draft: AnswerDraft): TableAnswerRequest {
  const before = question.answer
  const units = question.columns.flatMap((column) => {
    const { name, unit } = column
    if (unitChoices(question, column, draft).length > 0) return [[name, draft.units[name] ?? '']]
    // A unit that the table's kind defines is not in its header.
    const stated = draft.channels[name] ?? null
    return unit && unitsOf(question, stated).includes(unit) ? [[name, unit]] : []
  })
  const channels = Object.entries(draft.channels).filter(([, stated]) => stated !== null)
  return {
    time_zone: question.time_zone ? draft.zone : (before?.time_zone ?? null),
    rows_per_second: question.rows_per_second ? draft.rate : (before?.rows_per_second ?? null),
    date_order: draft.order,
    units: { ...before?.units, ...(Object.fromEntries(units) as Record<string, string>) },
    channels: { ...before?.channels, ...(Object.fromEntries(channels) as Record<string, string>) },
    read_again: draft.read_again,
  }
}

const DATE = /^\s*((\d{1,2})([./-])(\d{1,2})\3(\d{4}|\d\d))(?!\d)/
const EXAMPLE = '03/04/2025'

/** A date of the table, and as 2025-04-03 what it is in both orders; an example where the first
    rows show none. */
export function dateReadings({ columns }: TableQuestion): Record<'date' | DateOrder, string> {
  const cells = columns.filter(({ channel }) => channel === TIME).flatMap(({ samples }) => samples)
  const dates = [...cells, EXAMPLE].map((cell) => DATE.exec(cell))
  const [, date = '', first = '', , second = '', year = ''] =
    dates.find((match) => match && match[2] !== match[4]) ?? []
  const on = (month: string, day: string) =>
    [year.padStart(4, '20'), month.padStart(2, '0'), day.padStart(2, '0')].join('-')
  return { date, day_first: on(second, first), month_first: on(first, second) }
}

// What rides say about a table: which columns hardly act, in a sentence, and the numbers of a cell.
import type { TableUse } from '$shared/api/types'
import type { Locale } from '$shared/i18n/locale.svelte'
import type { Units } from '$shared/units/units.svelte'
import type { Block } from './table'

/** Columns that together act less than this share of the time are hardly felt. */
const HARDLY = 0.02

/** A share in per cent as short as it can be read; what is not nothing never reads 0. */
export function percent(locale: Locale, part: number): string {
  if (part > 0 && part < 0.0005) return `<${locale.number(0.1, 1)}`
  if (part === 0 || part === 1 || (part >= 0.0995 && part < 0.995)) return locale.number(part * 100)
  return part < 0.0995 ? locale.number(part * 100, 1) : locale.share(part)
}

/** The first of the columns from which on all together hardly act, and what they come to; null if
    even the last one acts. */
export function hardlyActing(shares: readonly number[]): { from: number; share: number } | null {
  const together = (from: number) => shares.slice(from).reduce((sum, share) => sum + share, 0)
  // The first column is left: where all of them are counted, something acts.
  const from = shares.findIndex((_, column) => column > 0 && together(column) <= HARDLY)
  return from < 0 ? null : { from, share: together(from) }
}

function ridesText({ t }: Locale, count: number): string {
  return count === 1 ? t('tune.use_rides_one') : t('tune.use_rides_many', { count })
}

/** What the rides say about the table, or why they say nothing. rateText: how a point is shown. */
export function useSentence(locale: Locale, use: TableUse, rateText: (rate: number) => string) {
  const { t } = locale
  const [count, others] = [use.rides.length, use.rides_without.length]
  if (count === 0) return silence(locale, use)
  const rides = ridesText(locale, count)
  const shares = use.columns.map((column) => column.share ?? 0)
  const right = hardlyActing(shares)
  const rate = rateText(use.columns[(right?.from ?? 1) - 1]?.point ?? NaN)
  const sentence = !right
    ? t('tune.use_all', { share: percent(locale, Math.min(...shares)), rides })
    : right.share > 0
      ? t('tune.use_right', { rate, share: percent(locale, right.share), rides })
      : t('tune.use_right_never', { rate, rides })
  if (others === 0) return sentence
  const more =
    others === 1 ? t('tune.use_others_one') : t('tune.use_others_many', { count: others })
  return `${sentence} ${more}`
}

function silence(locale: Locale, { rides_without }: TableUse): string {
  const { t } = locale
  if (rides_without.length === 0) return t('tune.use_no_ride')
  const rides = ridesText(locale, rides_without.length)
  const unassisted = rides_without.some((ride) => ride.code === 'not_assisted')
  return t(unassisted ? 'tune.use_unassisted' : 'tune.use_lacking', { rides })
}

/** How much the cells of a block were ridden. */
export function blockSentence(locale: Locale, units: Units, use: TableUse | null, block: Block) {
  const { t } = locale
  if (!use?.assisted_s) return t('tune.use_here_unknown')
  const sum = (cells: number[][]) =>
    cells
      .slice(block.top, block.bottom + 1)
      .flatMap((row) => row.slice(block.left, block.right + 1))
      .reduce((total, one) => total + one, 0)
  const seconds = sum(use.cells.seconds)
  if (seconds === 0) return t('tune.use_here_never', { rides: ridesText(locale, use.rides.length) })
  return t('tune.use_here', {
    share: percent(locale, seconds / use.assisted_s),
    time: seconds < 10 ? units.text(seconds, 's', 1) : locale.duration(seconds),
    energy: use.cells.motor_wh
      ? units.text(sum(use.cells.motor_wh), 'Wh', 2)
      : t('tune.use_energy_unknown'),
  })
}

/** The share of each cell; null where no ride has data. */
export function cellShares(use: TableUse | null): number[][] | null {
  if (!use?.assisted_s) return null
  return use.cells.seconds.map((row) => row.map((seconds) => seconds / use.assisted_s))
}

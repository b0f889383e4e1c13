// What the bars of weeks or months say in words, and how high they are.
import type { PeriodTotals } from '$shared/api/types'

export type Row = 'distance_km' | 'rider_wh' | 'motor_wh'

/** Heights of bars in percent of the highest; null where nothing is known. */
export function heights(periods: readonly PeriodTotals[], row: Row): (number | null)[] {
  const values = periods.map((period) => period[row])
  const top = Math.max(...values.map((value) => value ?? 0))
  return values.map((value) => (value === null ? null : top > 0 ? (100 * value) / top : 0))
}

export type Lack = { period: PeriodTotals; kind: 'all' | 'some'; count: number }

/** Periods whose motor total is not of all their rides. */
export function lacking(periods: readonly PeriodTotals[]): Lack[] {
  return periods
    .map((period) => ({ period, count: period.rides - period.with_motor }))
    .filter(({ count }) => count > 0)
    .map(({ period, count }) => ({
      period,
      count,
      kind: period.with_motor === 0 ? ('all' as const) : ('some' as const),
    }))
}

/** The first day of the reader's week, 1 Monday to 7 Sunday. */
export function weekBegins(locale: string): number {
  const info = new Intl.Locale(locale) as Intl.Locale & {
    getWeekInfo?: () => { firstDay: number }
    weekInfo?: { firstDay: number }
  }
  return info.getWeekInfo?.().firstDay ?? info.weekInfo?.firstDay ?? 1
}

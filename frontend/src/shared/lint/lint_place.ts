// Where the linter found something, in the reader's words and units.
import { parameterLabel } from '../config/parameter_text'
import type { Locale } from '../i18n/locale.svelte'
import type { Units } from '../units/units.svelte'

/** Words for a place: `rules[2][0]`, `modes[3]`, "9.4 km/h, torque rate 0.87", a parameter. */
export function lintPlace(where: string, locale: Locale, units: Units): string {
  const { t } = locale
  const at = (pattern: RegExp) => pattern.exec(where)?.slice(1).map(Number)
  const one = (n: number | undefined) => (n ?? NaN) + 1 // people count from one
  const cell = at(/^rules\[(\d+)\]\[(\d+)\]$/)
  if (cell) return t('lint.cell', { row: one(cell[0]), column: one(cell[1]) })
  const row = at(/^rules\[(\d+)\]$/)
  if (row) return t('lint.row', { row: one(row[0]) })
  const column = at(/^rules\[\]\[(\d+)\]$/)
  if (column) return t('lint.column', { column: one(column[0]) })
  const mode = at(/^modes\[(\d+)\](?:\.\w+)?$/)
  if (mode) return t('lint.mode', { mode: mode[0] ?? NaN }) // slots are called by their number
  if (where === 'modes') return t('lint.modes')
  const point = at(/^([\d.]+) km\/h, torque rate ([\d.]+)$/)
  if (point) {
    const speed = units.text(point[0], 'km/h')
    return t('lint.point', { speed, rate: locale.number(point[1], 2) })
  }
  const rate = at(/^torque rate ([\d.]+)$/)
  if (rate) return t('lint.rate', { rate: rate[0] ?? NaN })
  return parameterLabel(locale, where)
}

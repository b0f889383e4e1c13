// A value of the unit's calibration record, in words.
import { singleText } from '$shared/config/parameter_text'
import type { Locale } from '$shared/i18n/locale.svelte'
import type { RecordLine } from '../job/types'

const DIGITS: Readonly<Record<string, number>> = {
  sensor_offset_counts: 1,
  sensor_gain_nm_per_count: 6,
  sensor_offset_counts_per_k: 3,
  sensor_gain_share_per_k: 6,
  sensor_reference_degc: 1,
}

export function recordText(locale: Locale, name: string, value: RecordLine['found']): string {
  if (value === null) return '—'
  const single = singleText(locale, name, value)
  if (single !== null) return single
  return typeof value === 'number' ? locale.number(value, DIGITS[name] ?? 0) : String(value)
}

// A value of the unit's calibration record, in words.
import type { Locale } from '$shared/i18n/locale.svelte'
import type { RecordLine } from '../job/types'

const DIGITS: Readonly<Record<string, number>> = {
  sensor_offset_counts: 1,
  sensor_gain_nm_per_count: 6,
  sensor_offset_counts_per_k: 3,
  sensor_gain_share_per_k: 6,
  sensor_reference_degc: 1,
}
const MS_PER_S = 1000

export function recordText(locale: Locale, name: string, value: RecordLine['found']): string {
  if (value === null || (name === 'calibrated_at_utc_s' && value === 0)) return '—'
  if (name === 'calibrated_at_utc_s' && typeof value === 'number') {
    return locale.instant(new Date(value * MS_PER_S).toISOString())
  }
  if (typeof value === 'number') return locale.number(value, DIGITS[name] ?? 0)
  // Bytes, such as those of the certificate.
  if (Array.isArray(value)) {
    return value.map((byte) => Number(byte).toString(16).padStart(2, '0')).join('')
  }
  return value
}

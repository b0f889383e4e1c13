// Figures of how a table feels, as people read them.
import type { Feel } from '$shared/api/types'
import type { Locale } from '$shared/i18n/locale.svelte'
import type { Say } from './words'

export const FIGURES = [
  { name: 'start_s', unit: 'start_unit', digits: 1 },
  { name: 'rise_nm_per_s', unit: 'rise_unit', digits: 2 },
  { name: 'ripple_pct', unit: 'ripple_unit', digits: 1, term: 'ripple' },
  { name: 'lag_ms', unit: 'lag_unit', digits: 0, term: 'lag' },
  { name: 'toggles_hz', unit: 'toggles_unit', digits: 1 },
] as const

export type Figure = (typeof FIGURES)[number]

/** A figure with its unit; a dash for one that is missing. */
export function feelText(locale: Locale, say: Say, figure: Figure, feel: Feel | null): string {
  const value = feel?.[figure.name]
  if (value == null) return '—'
  return say(figure.unit, { value: locale.number(value, figure.digits) })
}

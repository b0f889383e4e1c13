// Dates and shares of temperature as the drift watch shows them.
import type { Locale } from '$shared/i18n/locale.svelte'
import type { Units } from '$shared/units/units.svelte'

/** The day of an ISO 8601 instant, with its year; "—" for none. */
export function dateText(locale: Locale, iso: string | null): string {
  if (!iso) return '—'
  const tag = locale.language === 'zh' ? 'zh-CN' : 'en-GB'
  return new Intl.DateTimeFormat(tag, { dateStyle: 'medium' }).format(Date.parse(iso))
}

/** Nm/K, or by degrees of Fahrenheit to those who read these. */
export function perDegree(units: Units, nm_per_k: number): string {
  const degree_k = 1 / (units.show(1, 'degC') - units.show(0, 'degC'))
  return `${units.text(nm_per_k * degree_k, 'Nm', 4)}/${degree_k === 1 ? 'K' : units.label('degC')}`
}

import type { Locale } from '$shared/i18n/locale.svelte'
import { ageOf } from './fleet'

/** The reader's day of an instant, as a date field has it: 2026-07-13. */
export function dayOf(instant: Date): string {
  return instant.toLocaleDateString('sv')
}

/** "3 hours ago", for what was `age_ms` ago. */
export function ageText(locale: Locale, age_ms: number): string {
  const [count, measure] = ageOf(age_ms / 1000)
  const tag = locale.language === 'zh' ? 'zh-CN' : 'en-GB'
  return new Intl.RelativeTimeFormat(tag, { style: 'short' }).format(-count, measure)
}

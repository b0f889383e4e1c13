// What the server says of a calibration with a code: in English as it says it, else by the code.
import type { Locale } from '$shared/i18n/locale.svelte'
import { TOLD, told as words, type ToldCode } from './told_words.svelte'
import type { Cause, Check, Reason } from '../job/types'

const DIGITS = 2

interface Said {
  code: string
  sentence: string
  figure?: number | null
  values?: Record<string, number | string>
  allowed?: number | null
}

/** The sentence of a check, a refusal or a cause. */
export function sentenceOf(locale: Locale, said: Reason | Check | Cause): string {
  const { code, sentence, figure, allowed, values } = said as Said
  const shown = Object.entries({ allowed, ...values, figure }).map(([name, value]) => [
    name,
    typeof value === 'number' ? rounded(locale, value) : (value ?? '—'),
  ])
  // A code that a newer server has is no word of ours.
  if (!(TOLD as readonly string[]).includes(code)) return sentence
  const values_shown = Object.fromEntries(shown) as Record<string, string>
  return words(locale)(code as ToldCode, { ...values_shown, sentence })
}

/** As many decimals as it has, two at most. */
function rounded(locale: Locale, value: number): string {
  const digits = [0, 1].find((n) => Math.abs(value - Number(value.toFixed(n))) < 1e-9) ?? DIGITS
  return locale.number(value, digits)
}

// The reader's language: words from a typed dictionary, numbers and times by Intl.
import { en, type Key } from './en'
import { zh } from './zh'
import { zhCodes, type Saying } from './zh_codes'

export type Language = 'en' | 'zh'
export type Values = Record<string, string | number>
export type Words = (key: Key, values?: Values) => string
const dictionaries: Record<Language, Record<Key, string>> = { en, zh }
const tags: Record<Language, string> = { en: 'en-GB', zh: 'zh-CN' }

export class Locale {
  language = $state<Language>('en')

  constructor(language: Language) {
    this.language = language
  }

  /** The words for a key; `{name}` in them is replaced by `values.name`. */
  t: Words = (key, values) => fill(dictionaries[this.language][key], values)

  /** The words for a key made at run time, or the fallback where the dictionary has none. */
  lookup = (key: string, fallback: string): string => {
    const words = dictionaries[this.language] as Record<string, string>
    return words[key] ?? fallback
  }

  /** What the server says in English and with a code: translated by its code where it is known.
      `{name}` in the translation is replaced by `values.name`. */
  said(kind: Saying, code: string, english: string, values?: Values): string {
    if (this.language === 'en') return english
    return fill((zhCodes[kind] as Record<string, string>)[code] ?? english, values)
  }

  /** A number with a fixed count of decimals; "—" for a missing one. */
  number(value: number | null | undefined, digits = 0): string {
    if (value == null || !Number.isFinite(value)) return '—'
    return new Intl.NumberFormat(tags[this.language], {
      minimumFractionDigits: digits,
      maximumFractionDigits: digits,
    }).format(Object.is(value, -0) ? 0 : value)
  }

  /** A share in per cent with one decimal. Rounded down: what is not whole never reads 100. */
  share(part: number): string {
    return this.number(Math.floor(part * 1000) / 10, 1)
  }

  /** Day and time of day of an ISO 8601 instant, in the reader's time zone. */
  instant(iso: string | null | undefined): string {
    if (!iso) return '—'
    const format = { dateStyle: 'medium', timeStyle: 'short' } as const
    return new Intl.DateTimeFormat(tags[this.language], format).format(Date.parse(iso))
  }

  /** A duration as h:mm:ss. */
  duration(seconds: number | null | undefined): string {
    if (seconds == null || !Number.isFinite(seconds)) return '—'
    return clock(seconds)
  }
}

/** h:mm:ss of a duration in seconds; below an hour m:ss. */
export function clock(seconds: number): string {
  const whole = Math.max(0, Math.round(seconds))
  const [h, m, s] = [Math.floor(whole / 3600), Math.floor(whole / 60) % 60, whole % 60]
  const tail = String(s).padStart(2, '0')
  return h > 0 ? `${h}:${String(m).padStart(2, '0')}:${tail}` : `${m}:${tail}`
}

function fill(words: string, values: Values = {}): string {
  return words.replace(/\{(\w+)\}/g, (whole, name: string) => String(values[name] ?? whole))
}

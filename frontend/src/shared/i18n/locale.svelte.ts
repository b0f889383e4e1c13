// The reader's language: messages common to all pages, numbers and times by Intl.
import { dictionaryOf, english, type CodeKind, type Key, type Language } from './dictionary'

export type { Key, Language }
export type Values = Record<string, string | number>
export type Words = (key: Key, values?: Values) => string
const tags: Record<Language, string> = { en: 'en-GB', zh: 'zh-CN' }

/** English to begin with; another language is fetched when it is spoken first. */
export class Locale {
  private spoken = $state.raw<Language>('en')
  private dictionary = $state.raw(english)

  get language(): Language {
    return this.spoken
  }

  /** Changes the language. Rejects and changes nothing if its words cannot be fetched. */
  async speak(language: Language): Promise<void> {
    this.dictionary = await dictionaryOf(language)
    this.spoken = language
  }

  /** The words for a key; `{name}` in them is replaced by `values.name`. */
  t: Words = (key, values) => fill(this.dictionary.words[key], values)

  /** The words for a key made at run time, or the fallback where the dictionary has none. */
  lookup = (key: string, fallback: string): string => {
    return (this.dictionary.words as Record<string, string>)[key] ?? fallback
  }

  /** What the server says in English and with a code: translated by its code where it is known.
      `{name}` in the translation is replaced by `values.name`. */
  translated(kind: CodeKind, code: string, english: string, values?: Values): string {
    const translated = this.dictionary.codes[kind]?.[code]
    return translated === undefined ? english : fill(translated, values)
  }

  /** A number with a fixed count of decimals; "—" for a missing one. */
  number(value: number | null | undefined, digits = 0): string {
    if (value == null || !Number.isFinite(value)) return '—'
    return new Intl.NumberFormat(tags[this.language], {
      minimumFractionDigits: digits,
      maximumFractionDigits: digits,
      signDisplay: 'negative', // of what is not nothing when rounded
    }).format(value)
  }

  /** A share in per cent with one decimal. Rounded down: what is not complete never reads 100. */
  share(part: number): string {
    return this.number(Math.floor(part * 1000) / 10, 1)
  }

  /** Day and time of day of an ISO 8601 instant, in the reader's time zone. */
  instant(iso: string | null | undefined): string {
    if (!iso) return '—'
    const format = { dateStyle: 'medium', timeStyle: 'short' } as const
    return new Intl.DateTimeFormat(tags[this.language], format).format(Date.parse(iso))
  }

  /** A date such as 2026-07-13, in full. */
  date(date: string): string {
    const format = { dateStyle: 'long', timeZone: 'UTC' } as const
    return new Intl.DateTimeFormat(tags[this.language], format).format(Date.parse(date))
  }

  /** A date such as 2026-07-13, short; by_month: its month alone. */
  day(date: string, by_month = false): string {
    const format = { month: 'short', timeZone: 'UTC' } as const
    const shown = by_month ? format : ({ ...format, day: 'numeric' } as const)
    return new Intl.DateTimeFormat(tags[this.language], shown).format(Date.parse(date))
  }

  /** Time of day of a time in ms; with its day where that is not today. */
  timeOfDay(at_ms: number): string {
    const tag = tags[this.language]
    const day = new Intl.DateTimeFormat(tag, { day: 'numeric', month: 'short' })
    const time = new Intl.DateTimeFormat(tag, { hour: '2-digit', minute: '2-digit' }).format(at_ms)
    const [then, today] = [day.format(at_ms), day.format(Date.now())]
    return then === today ? time : `${then}, ${time}`
  }

  /** A duration as h:mm:ss. */
  duration(seconds: number | null | undefined): string {
    if (seconds == null || !Number.isFinite(seconds)) return '—'
    return clock(seconds)
  }
}

/** h:mm:ss of a duration in seconds; below an hour m:ss. */
export function clock(seconds: number): string {
  const total = Math.max(0, Math.round(seconds))
  const [h, m, s] = [Math.floor(total / 3600), Math.floor(total / 60) % 60, total % 60]
  const tail = String(s).padStart(2, '0')
  return h > 0 ? `${h}:${String(m).padStart(2, '0')}:${tail}` : `${m}:${tail}`
}

/** Words with their `{name}` replaced by `values.name`. */
export function fill(words: string, values: Values = {}): string {
  return words.replace(/\{(\w+)\}/g, (hole, name: string) => String(values[name] ?? hole))
}

// Messages common to all pages, and translations of what the server states with a code.
import type { ChannelName, FaultName, FLAGS, ParameterName } from '$generated/registry'
import en from '$messages/en/pages.json'
import type codes from '$messages/zh/codes.json'

export type Language = 'en' | 'zh'
export type Key = keyof typeof en
/** What the server states in English and with a code. */
export type CodeKind = keyof typeof codes

export interface Dictionary {
  words: Record<Key, string>
  codes: Partial<Record<CodeKind, Record<string, string>>>
}

type OfTheRegistry =
  | `parameter.${ParameterName}`
  | `channel.${ChannelName}`
  | `fault_flag.${FaultName}`
  | `limit.${keyof typeof FLAGS.limit_flags}`

export const english: Dictionary = { words: en satisfies Record<OfTheRegistry, string>, codes: {} }

/** Fetches the dictionary of a language. Rejects where it cannot be fetched. */
export async function dictionaryOf(language: Language): Promise<Dictionary> {
  if (language === 'en') return english
  const [words, codes] = await Promise.all([
    import('$messages/zh/pages.json'),
    import('$messages/zh/codes.json'),
  ])
  return { words: words.default, codes: codes.default }
}

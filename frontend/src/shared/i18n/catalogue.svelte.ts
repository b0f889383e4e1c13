// One feature's messages. They come with its pages, so that the first page need not carry them. Not
// Paraglide: what it compiles carries every language to every reader.
import { fill, type Locale, type Values } from './locale.svelte'

/** The messages of an English catalogue in the reader's language: English until the Chinese one is
    fetched by `load`. A page that opens in Chinese waits for it, so that no line changes its
    length. The compiler refuses a Chinese catalogue that lacks a key. */
export async function catalogue<Key extends string>(
  english: Record<Key, string>,
  load: () => Promise<{ default: Record<Key, string> }>,
): Promise<(locale: Locale) => (key: Key, values?: Values) => string> {
  let chinese = $state.raw<Record<Key, string> | null>(null)
  // Without its catalogue a page stays in English: that is better than no page.
  const fetched = () => load().then(
    (module) => void (chinese = module.default),
    () => undefined,
  )
  if (document.documentElement.lang.startsWith('zh')) await fetched()
  return (locale) => (key, values) => {
    if (locale.language !== 'zh') return fill(english[key], values)
    if (chinese === null) void fetched()
    return fill((chinese ?? english)[key], values)
  }
}

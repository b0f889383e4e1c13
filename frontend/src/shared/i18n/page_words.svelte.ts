// Words that come with one page, so that the first page need not carry them.
import { fill, type Locale, type Values } from './locale.svelte'

/** A page's words in the reader's language; English until another language's are here. Who reads
    another language waits for them, so that no line changes its length under his eyes. */
export async function pageWords<Key extends string>(
  english: Record<Key, string>,
  load: () => Promise<Record<Key, string>>,
): Promise<(locale: Locale) => (key: Key, values?: Values) => string> {
  let chinese = $state.raw<Record<Key, string> | null>(null)
  // What cannot be fetched leaves the page in English: that is better than no page.
  const fetched = () => load().then(
    (words) => void (chinese = words),
    () => undefined,
  )
  if (document.documentElement.lang.startsWith('zh')) await fetched()
  return (locale) => (key, values) => {
    if (locale.language !== 'zh') return fill(english[key], values)
    if (chinese === null) void fetched()
    return fill((chinese ?? english)[key], values)
  }
}

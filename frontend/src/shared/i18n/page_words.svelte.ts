// Words that come with one page, so that the first page need not carry them.
import { fill, type Locale, type Values } from './locale.svelte'

/** A page's words in the reader's language; English until another language's are here. */
export function pageWords<Key extends string>(
  english: Record<Key, string>,
  load: () => Promise<Record<Key, string>>,
): (locale: Locale) => (key: Key, values?: Values) => string {
  let chinese = $state.raw<Record<Key, string> | null>(null)
  return (locale) => (key, values) => {
    if (locale.language !== 'zh') return fill(english[key], values)
    if (chinese === null) void load().then((words) => (chinese = words))
    return fill((chinese ?? english)[key], values)
  }
}

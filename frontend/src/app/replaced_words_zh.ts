// Chinese: a bike in the place of another.
import type { ReplacedKey } from './replaced_words.svelte'

export const zh: Record<ReplacedKey, string> = {
  replaced: '这是另一辆车：原来接着 {before} 的地方，现在是 {name}。',
  edits_kept: '为 {before} 所做的修改（{count} 处）已保留，它重新连上时仍在。',
}

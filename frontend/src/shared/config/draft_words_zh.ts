// Chinese: what is said of a draft.
import type { DraftKey } from './draft_words.svelte'

export const zh: Record<DraftKey, string> = {
  kept: '自 {time} 起保存在此浏览器中。',
  meanwhile: '期间单元中已更改并保留：{count} 项。',
}

// Chinese: a server that cannot keep everything.
import type { HealthKey } from './health_words.svelte'

export const zh: Record<HealthKey, string> = {
  degraded: '现在记录的数据不能全部保存。',
  was_degraded: '已记录的数据不完整。',
}

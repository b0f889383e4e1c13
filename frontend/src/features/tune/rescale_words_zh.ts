import type { en } from './rescale_words.svelte'

export const zh: Record<keyof typeof en, string> = {
  cancel: '取消',
  rescale_title: '您的骑行所用到的扭矩变化率峰点',
  rescale_note: '把扭矩上升的时间均分给各峰点；第一个仍为 0。两个表共用这些峰点，每条规则保持其标签。',
  rescale_now: '现在',
  rescale_then: '建议',
  rescale_time: '时间',
  rescale_judging: '正在检查建议…',
  rescale_clean: '检查未发现新的问题。',
  rescale_found: '检查发现新的问题：',
  rescale_take: '放入草稿',
}

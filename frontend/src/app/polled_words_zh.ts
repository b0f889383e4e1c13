// Chinese: values that come one by one.
import type { PolledKey } from './polled_words.svelte'

export const zh: Record<PolledKey, string> = {
  polled: '实时连接（WebSocket）不通：数值每秒更新一次。',
  proxy: '途中的代理没有转发该连接；设置方法见 docs/behind-a-proxy.md。',
}

// The words of values that come one by one. They come when that happens.
import { pageWords } from '$shared/i18n/page_words.svelte'

export const en = {
  polled: 'The live connection (WebSocket) does not come through: values come once a second.',
  proxy: 'A proxy on the way does not pass it on; how to set it: docs/behind-a-proxy.md.',
}

export type PolledKey = keyof typeof en

export const polledWords = await pageWords(en, async () => (await import('./polled_words_zh')).zh)

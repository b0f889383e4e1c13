/* Goal: an open page notices that the server has other pages, and ignores answers of a proxy. */
import { afterEach, describe, expect, it, vi } from 'vitest'
import { BuildWatch } from './build_watch.svelte'

const page = (entry: string) =>
  `<head><script type="module" crossorigin src="/assets/${entry}"></script></head><div id="app">`

afterEach(() => vi.unstubAllGlobals())

async function isReplaced(answer: () => Promise<Response>): Promise<boolean> {
  vi.stubGlobal('fetch', answer)
  const watch = new BuildWatch('index-Aa11.js', '/')
  await watch.check()
  return watch.is_old
}

describe('a page that stays open', () => {
  it('is of the same build while the server has its entry', async () => {
    expect(await isReplaced(async () => new Response(page('index-Aa11.js')))).toBe(false)
  })

  it('is old once the server has another', async () => {
    expect(await isReplaced(async () => new Response(page('index-Bb22.js')))).toBe(true)
  })

  it.each([
    ['a proxy that wants a word first', async () => new Response('<form src="login-1.js">')],
    ['an error', async () => new Response(page('index-Bb22.js'), { status: 502 })],
    ['nobody', () => Promise.reject(new TypeError('Failed to fetch'))],
  ])('takes no word from %s', async (_, answer) => {
    expect(await isReplaced(answer)).toBe(false)
  })
})

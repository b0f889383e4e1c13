/* Goal: the action bar that a user works with stays, whatever a page learns meanwhile. */
import type { Snippet } from 'svelte'
import { expect, it } from 'vitest'
import { Foot } from './foot.svelte'

const [page, chosen] = [() => 1, () => 2] as unknown as Snippet[] as [Snippet, Snippet]

it('shows the last that came, and the one before when it goes', () => {
  const foot = new Foot()
  foot.show(page)
  const gone = foot.show(chosen)

  expect(foot.bar).toBe(chosen)
  gone()
  expect(foot.bar).toBe(page)
})

it('keeps what is chosen on top of a bar that comes later to lie beneath', () => {
  const foot = new Foot()
  const gone = foot.show(chosen)
  foot.show(page, true)

  expect(foot.bar).toBe(chosen)
  gone()
  expect(foot.bar).toBe(page)
})

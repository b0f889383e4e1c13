// @vitest-environment happy-dom
/* Goal: g and a letter goes to a page, soon after each other and not while typing. */
import { expect, it } from 'vitest'
import { GoKeys } from './go_keys'

type Press = [string, number, Element?]

function pressed(...keys: Press[]): string[] {
  return pressedBy(() => true, ...keys)
}

function pressedBy(has: (path: string) => boolean, ...keys: Press[]): string[] {
  const seen: string[] = []
  const go = new GoKeys((path) => seen.push(path), () => seen.push('list'), has)
  for (const [key, at_ms, target = document.body] of keys) {
    const event = new KeyboardEvent('keydown', { key })
    Object.defineProperty(event, 'target', { value: target })
    go.key(event, at_ms)
  }
  return seen
}

it('goes where the letter says', () => {
  expect(pressed(['g', 0], ['t', 300], ['g', 1000], ['b', 1200])).toEqual(['tune', '.'])
})

it('goes to no page that somebody does not have', () => {
  const rider = (path: string) => path !== 'tune'

  expect(pressedBy(rider, ['g', 0], ['t', 300], ['g', 1000], ['f', 1200])).toEqual(['fleet'])
})

it('forgets a g after a while, and a letter alone does nothing', () => {
  expect(pressed(['g', 0], ['t', 5000], ['t', 5100])).toEqual([])
})

it('lists the keys, but not in a field that is being typed in', () => {
  const field = document.createElement('input')

  expect(pressed(['?', 0], ['?', 1, field], ['g', 2, field], ['r', 3])).toEqual(['list'])
})

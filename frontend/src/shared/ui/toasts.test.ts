/* Goal: good news leaves by itself but not from under a reader's hand, and a failure stays until it
   is dismissed, whatever good news comes after it. */
import { afterEach, beforeEach, expect, it, vi } from 'vitest'
import { Toasts } from './toasts.svelte'

beforeEach(() => {
  vi.useFakeTimers()
})
afterEach(() => {
  vi.useRealTimers()
})
const words = (toasts: Toasts) => toasts.items.map((toast) => toast.text)
const LONG_MS = 60_000

it('lets good news go and keeps a failure', () => {
  const toasts = new Toasts()
  toasts.say('ok', 'written')
  toasts.say('bad', 'not written')

  vi.advanceTimersByTime(LONG_MS)

  expect(words(toasts)).toEqual(['not written'])
})

it('keeps good news while the pointer is over it, and lets it go after that', () => {
  const toasts = new Toasts()
  toasts.say('ok', 'written')
  const id = toasts.items[0]?.id ?? 0
  toasts.hold(id)

  vi.advanceTimersByTime(LONG_MS)
  expect(words(toasts)).toEqual(['written'])
  toasts.release(id)
  vi.advanceTimersByTime(LONG_MS)

  expect(words(toasts)).toEqual([])
})

it('drops good news rather than an unseen failure', () => {
  const toasts = new Toasts()
  toasts.say('bad', 'not written')
  for (const text of ['one', 'two', 'three']) toasts.say('ok', text)

  expect(words(toasts)).toEqual(['not written', 'two', 'three'])
})

it('says the same failure once', () => {
  const toasts = new Toasts()
  toasts.say('bad', 'not written')
  toasts.say('bad', 'not written')

  expect(words(toasts)).toEqual(['not written'])
})

/* Goal: a moving pointer requests hundreds of times; the first is answered at once, then the
   newest, no oftener than the pace allows. Safari throws after 100 changes of the address in 30 s.
   */
import { afterEach, beforeEach, expect, it, vi } from 'vitest'
import { Pace } from './pace'

beforeEach(() => void vi.useFakeTimers())
afterEach(() => void vi.useRealTimers())

it('does the first at once, and of a quick row the last', () => {
  const pace = new Pace(350)
  const done: number[] = []

  for (let i = 0; i < 5; i++) pace.soon(() => void done.push(i))
  expect(done).toEqual([0])
  vi.advanceTimersByTime(350)

  expect(done).toEqual([0, 4])
})

it('stays below 100 in 30 s, and goes on while the hand moves', () => {
  const pace = new Pace(350)
  let count = 0

  for (let at_ms = 0; at_ms < 30_000; at_ms += 10) {
    pace.soon(() => void count++)
    vi.advanceTimersByTime(10)
  }

  expect(count).toBeGreaterThan(80)
  expect(count).toBeLessThan(100)
})

it('sends one at a time: a slow answer is waited for, then the newest is sent', async () => {
  const pace = new Pace(40)
  const requests: number[] = []
  const answer = (i: number) => () => {
    requests.push(i)
    return new Promise<void>((resolve) => setTimeout(resolve, 200))
  }

  for (let i = 0; i < 10; i++) {
    pace.soon(answer(i))
    await vi.advanceTimersByTimeAsync(30)
  }
  await vi.advanceTimersByTimeAsync(200)

  expect(requests).toEqual([0, 6, 9])
})

it('does nothing after its end', () => {
  const pace = new Pace(350)
  let count = 0
  pace.soon(() => void count++)
  pace.soon(() => void count++)

  pace.stop()
  vi.advanceTimersByTime(1000)

  expect(count).toBe(1)
})

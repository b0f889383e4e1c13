// @vitest-environment happy-dom
/* Goal: where no socket passes, what the unit sent last is given on once, and nothing else is. */
import { afterEach, beforeEach, expect, it, vi } from 'vitest'
import type { StreamFrame, StreamHeader } from './frame'
import { poll, type Newest } from './polled'

beforeEach(() => void vi.useFakeTimers())
afterEach(() => void vi.useRealTimers())

async function fed(...answers: (Newest | null)[]) {
  const headers: StreamHeader[] = []
  const frames: StreamFrame[] = []
  const fetchNewest = vi.fn(async () => {
    const answer = answers.shift()
    if (!answer) throw new Error('nobody answers')
    return answer
  })
  const taker = {
    begin: (header: StreamHeader) => void headers.push(header),
    take: (frame: StreamFrame) => void frames.push(frame),
  }
  const stop = poll(taker, ['speed_kmh', 'gone'], fetchNewest)
  await vi.advanceTimersByTimeAsync(answers.length * 1000)
  stop()
  const calls = fetchNewest.mock.calls.length
  await vi.advanceTimersByTimeAsync(5000)
  expect(fetchNewest.mock.calls.length).toBe(calls)
  return { headers, frames }
}

const at = (t_s: number, speed_kmh: number): Newest => ({
  t_us: t_s * 1e6,
  channels: { speed_kmh },
})

it('passes each row on once, in the requested channels', async () => {
  const { headers, frames } = await fed(at(1, 20.5), at(1, 20.5), null, at(3, 21))

  expect(headers.map((header) => header.channels.map(({ name }) => name))).toEqual([
    ['speed_kmh', 'gone'],
  ])
  expect(frames.map(({ t0_s, counts }) => [t0_s, ...counts])).toEqual([
    [1, 20.5, -32768],
    [3, 21, -32768],
  ])
})

it('stays silent while there is no answer', async () => {
  expect(await fed(null, null, null)).toEqual({ headers: [], frames: [] })
})

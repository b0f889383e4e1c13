/* Goal: the log holds the server's reports, once each, in order, and no more than is of use. */
import type { Device } from '$shared/api/types'
import { expect, it } from 'vitest'
import { ProbeLog, probeResult } from './probe_log.svelte'

const deviceIn = (state: Device['state'], reason_code: string) =>
  ({ id: 'one', state, reason: `${reason_code}.`, reason_code }) as Device

it('notes what is new and when, and begins again with a new attempt', () => {
  const log = new ProbeLog()
  log.note(deviceIn('connecting', 'opening'), 5000)
  log.note(deviceIn('connecting', 'opening'), 5250)
  log.note(deviceIn('ready', 'ready'), 5500)

  expect(log.of('one').map(({ after_s, reason }) => [after_s, reason])).toEqual([
    [0, 'opening.'],
    [0.5, 'ready.'],
  ])
  log.begin(deviceIn('connecting', 'port_busy'), 9000)
  expect(log.of('one').map(({ after_s, reason }) => [after_s, reason])).toEqual([[0, 'port_busy.']])
  expect(log.of('two')).toEqual([])
})

it('keeps the last tries of a unit that is away', () => {
  const log = new ProbeLog()
  for (let i = 0; i < 20; i++) {
    log.note(deviceIn('connecting', i % 2 ? 'nobody' : 'greeted'), i * 1000)
  }

  expect(log.of('one').map(({ number }) => number)).toEqual([13, 14, 15, 16, 17, 18, 19, 20])
})

it('calls a unit found only when it is ready, and what it does not know failed', () => {
  expect(probeResult(deviceIn('ready', 'no_stream'))).toBe('connected')
  expect(probeResult(deviceIn('read_only', 'read_only'))).toBe('older')
  expect(probeResult(deviceIn('connecting', 'port_permission'))).toBe('forbidden')
  expect(probeResult(deviceIn('closed', 'never_heard_of'))).toBe('failed')
})

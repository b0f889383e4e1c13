/* Goal: hundreds of files are one batch that can be paused, gone on with and stopped, and in which
   one bad file stops nothing. The sender is a fake that the test lets go; times are given. */
import { Refusal } from '$shared/api/client'
import type { Upload } from '$shared/api/types'
import type { uploadFile } from '$shared/api/upload'
import { expect, it } from 'vitest'
import { shownFiles } from './dropped'
import { ImportQueue } from './import_queue.svelte'

const verdict = (name: string): Upload =>
  ({
    state: name.startsWith('bad') ? 'rejected' : name.startsWith('cut') ? 'partial' : 'complete',
    code: name.startsWith('known') ? 'duplicate' : null,
    duplicate_of: name.startsWith('known') ? 1 : null,
    ride_ids: [1],
  }) as unknown as Upload

const files = (...names: string[]) => names.map((name) => new File([new Uint8Array(1000)], name))
const turn = () => new Promise((resolve) => setTimeout(resolve, 0))

class Sender {
  sending: string[] = []
  let_go: (() => void)[] = []
  fault: Error | null = null
  readonly send: typeof uploadFile = async (file, progress, _steps, gate) => {
    this.sending.push(file.name)
    if (this.fault) throw this.fault
    if (file.name.startsWith('held')) {
      await new Promise<void>((resolve) => this.let_go.push(resolve))
      progress(0.5)
      await gate?.()
    }
    return verdict(file.name)
  }
}

it('counts what became of each file, and one bad file stops nothing', async () => {
  const sender = new Sender()
  const queue = new ImportQueue(() => undefined, sender.send)
  const kinds = ['good', 'bad', 'cut', 'known']
  const names = Array.from({ length: 300 }, (_, i) => `${kinds[i % 4]} ${i}`)

  await queue.take(files(...names))

  const each = { complete: 75, rejected: 75, partial: 75, here: 75 }
  expect(queue.count).toMatchObject({ ...each, waiting: 0 })
  expect([queue.done, queue.share, queue.isGoing]).toEqual([300, 1, false])
})

it('sends three at once, pauses between parts, and goes on', async () => {
  const sender = new Sender()
  const queue = new ImportQueue(() => undefined, sender.send)
  const all = queue.take(files('held 1', 'held 2', 'held 3', 'good 4', 'good 5'))
  await turn()
  expect(sender.sending.length).toBe(3)

  queue.pause()
  sender.let_go.forEach((go) => go())
  await turn()
  expect([queue.done, sender.sending.length]).toEqual([0, 3])
  queue.resume()
  await all

  expect(queue.count.complete).toBe(5)
})

it('stops: what is not sent says so and can be chosen again', async () => {
  const sender = new Sender()
  const queue = new ImportQueue(() => undefined, sender.send)
  const all = queue.take(files('held 1', 'held 2', 'held 3', 'good 4', 'good 5'))
  await turn()

  queue.stop()
  sender.let_go.forEach((go) => go())
  await all
  expect([queue.count.stopped, queue.isGoing]).toEqual([5, false])

  await queue.take(files('good 4'))
  expect(queue.arrivals.map(({ standing }) => standing)).toEqual(['complete'])
})

it('pauses by itself while the server is away, and loses no file', async () => {
  const sender = new Sender()
  sender.fault = new Refusal(0, 'unreachable', 'no server')
  const queue = new ImportQueue(() => undefined, sender.send)
  const all = queue.take(files('a', 'b', 'c', 'd'))
  await turn()
  expect([queue.paused, queue.problem, queue.count.rejected]).toEqual([true, 'no server', 0])

  sender.fault = null
  queue.resume()
  await all

  expect(queue.count.complete).toBe(4)
})

it('says how long it takes, at the speed since it last began', async () => {
  let now_ms = 0
  const sender = new Sender()
  const queue = new ImportQueue(() => undefined, sender.send, () => now_ms)
  const all = queue.take(files('good 1', 'held 2', 'held 3', 'held 4'))
  await turn()
  now_ms = 2000

  // One of four equal files in two seconds.
  expect(queue.left_s).toBeCloseTo(6, 5)
  sender.let_go.forEach((go) => go())
  await turn()
  sender.let_go.forEach((go) => go())
  await all
})

it('leaves hidden files where they are', () => {
  expect(shownFiles(files('.DS_Store', 'a.fit')).map(({ name }) => name)).toEqual(['a.fit'])
})

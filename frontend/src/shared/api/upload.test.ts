/* Goal: a file arrives whole although the network breaks. The server here counts bytes and fails as
   told; tus 1.0 says that after a failure only the server knows how far it got. */
import { expect, it } from 'vitest'
import { Refusal } from './client'
import { uploadFile, type UploadSteps } from './upload'

class TusServer {
  received = new Uint8Array()
  polls = 0
  constructor(private readonly faults: ('network' | 'lost_answer' | 503 | 413 | 422)[]) {}

  readonly steps: UploadSteps = {
    wait: async () => undefined,
    fetch: async (_url, init) => this.answer(init ?? {}),
  }

  private async answer(init: RequestInit): Promise<Response> {
    const offset = { 'upload-offset': String(this.received.length) }
    if (init.method === 'POST') {
      return new Response(null, { status: 201, headers: { location: '/api/v1/uploads/1' } })
    }
    if (init.method === 'HEAD') return new Response(null, { headers: offset })
    if (init.method === 'PATCH') return this.append(init)
    this.polls += 1
    return Response.json({ id: '1', state: this.polls < 3 ? 'queued' : 'complete', ride_ids: [4] })
  }

  private async append(init: RequestInit): Promise<Response> {
    const fault = this.faults.shift()
    if (fault === 'network') throw new TypeError('network down')
    if (typeof fault === 'number') {
      return Response.json({ code: 'x', detail: 'no', errors: [] }, { status: fault })
    }
    const part = new Uint8Array(await (init.body as Blob).arrayBuffer())
    this.received = Uint8Array.from([...this.received, ...part])
    if (fault === 'lost_answer') throw new TypeError('answer lost')
    const headers = { 'upload-offset': String(this.received.length) }
    return new Response(null, { status: 204, headers })
  }
}

const bytes = Uint8Array.from({ length: 3_000_000 }, (_, i) => i % 251)
const file = new File([bytes], 'ride 骑行.fit')

it('stops sending what its first part shows to be no ride', async () => {
  const server = new TusServer([422])

  const upload = await uploadFile(file, () => undefined, server.steps)

  expect(server.received.length).toBe(0)
  expect(upload.id).toBe('1')
})

it.each([
  ['a network that drops out', ['network' as const]],
  ['a server that is busy', [503 as const, 503 as const]],
  ['an answer that is lost after its bytes arrived', ['lost_answer' as const]],
])('arrives whole despite %s', async (_, faults) => {
  const server = new TusServer([...faults])
  const shares: number[] = []

  const upload = await uploadFile(file, (share) => shares.push(share), server.steps)

  expect(upload.ride_ids).toEqual([4])
  expect(server.received.length).toBe(bytes.length)
  expect(server.received[2_999_999]).toBe(bytes[2_999_999])
  expect(shares.at(-1)).toBe(1)
})

it('is not tried again when the server says no', async () => {
  const server = new TusServer([413])

  await expect(uploadFile(file, () => undefined, server.steps)).rejects.toBeInstanceOf(Refusal)
})

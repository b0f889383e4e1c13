// @vitest-environment happy-dom
/* Goal: a file arrives complete although the network breaks. The server here counts bytes and fails
   on request; by tus 1.0 only the server knows after a failure how far it got. */
import type { HttpRequest, HttpStack } from 'tus-js-client'
import { afterEach, expect, it, vi } from 'vitest'
import { Refusal } from './client'
import { Stopped, uploadFile, type UploadSteps } from './upload'

class TusServer implements HttpStack {
  received = new Uint8Array()
  polls = 0
  hash: string | null = null
  existing: object[] = []
  begun: string[] = []
  readonly steps: UploadSteps

  constructor(private readonly faults: ('network' | 'lost_answer' | 503 | 413 | 422)[]) {
    this.steps = {
      wait: async () => undefined,
      sha256: async () => this.hash,
      retry_delays_ms: [0, 0, 0],
      http: this,
      fetch: async (url, init) => this.answer(String(url), init ?? {}),
    }
  }

  getName = () => 'a server in memory'

  /** A request of the protocol's client, answered by this server. */
  createRequest(method: string, url: string): HttpRequest {
    const headers = new Headers()
    return {
      getMethod: () => method,
      getURL: () => url,
      setHeader: (name, value) => headers.set(name, value),
      getHeader: (name) => headers.get(name) ?? undefined,
      setProgressHandler: () => undefined,
      abort: async () => undefined,
      getUnderlyingObject: () => null,
      send: async (body: BodyInit | null) => {
        const response = await this.answer(url, { method, headers, body })
        const text = await response.text()
        return {
          getStatus: () => response.status,
          getHeader: (name) => response.headers.get(name) ?? undefined,
          getBody: () => text,
          getUnderlyingObject: () => null,
        }
      },
    }
  }

  private async answer(url: string, init: RequestInit): Promise<Response> {
    const offset = {
      'upload-offset': String(this.received.length),
      'upload-length': String(bytes.length),
    }
    if (url.includes('sha256=')) return Response.json({ items: this.existing, next: null })
    if (init.method === 'POST') {
      this.begun.push(new Headers(init.headers).get('upload-metadata') ?? '')
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

afterEach(() => {
  vi.unstubAllGlobals()
  localStorage.clear()
})

it('goes on where it stood when the page was loaded anew', async () => {
  const server = new TusServer([])
  let parts = 0
  const closed = async () => {
    if (parts++ === 2) throw new Stopped()
  }
  await expect(uploadFile(file, () => undefined, server.steps, closed)).rejects.toThrow(Stopped)
  const before = server.received.length

  const upload = await uploadFile(file, () => undefined, server.steps)

  expect(before).toBe(2 << 20)
  expect(server.begun.length).toBe(1)
  expect(server.received.length).toBe(bytes.length)
  expect(upload.ride_ids).toEqual([4])
  expect(localStorage.length).toBe(0)
})

it('sends nothing of what is here already, and says what it will hash to of the rest', async () => {
  const server = new TusServer([])
  server.hash = 'ab'.repeat(32)
  await uploadFile(file, () => undefined, server.steps)
  server.existing = [{ ride_ids: [], parts: null }, { ride_ids: [7], parts: null }]

  const upload = await uploadFile(file, () => undefined, server.steps)

  expect(upload).toMatchObject({ code: 'duplicate', duplicate_of: 7 })
  expect(server.begun).toEqual([expect.stringContaining(`,sha256 ${btoa(server.hash)}`)])
})

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
])('arrives complete despite %s', async (_, faults) => {
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

it('ends with the reason where the browser does not show what it stored', async () => {
  const { steps } = new TusServer([])
  const key = () => {
    throw new DOMException('storage is blocked', 'SecurityError')
  }
  vi.stubGlobal('localStorage', { length: 1, key })

  await expect(uploadFile(file, () => undefined, steps)).rejects.toThrow('blocked')
})

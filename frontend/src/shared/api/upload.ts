// One file to the server by tus 1.0: resumes where the server has it, then waits for the verdict.
// tus-js-client: the protocol's own client, MIT; it comes with the first file.
import type {
  DetailedError,
  HttpRequest,
  HttpResponse,
  HttpStack,
  Upload as Sending,
} from 'tus-js-client'
import { Refusal, refusal } from './client'
import type { Upload, UploadList } from './types'

const CHUNK_BYTES = 1 << 20
const HASHED_BYTES_MAX = 64 << 20
const VERDICT_POLLS_MAX = 600

export interface UploadSteps {
  fetch: typeof fetch
  wait: (ms: number) => Promise<void>
  sha256: (file: File) => Promise<string | null>
  retry_delays_ms: number[]
  /** How parts are sent; by the browser's own requests where there is none. */
  http?: HttpStack
}

/** The sender stopped the upload. */
export class Stopped extends Error {}

const browser: UploadSteps = {
  fetch: (...request) => fetch(...request),
  wait: (ms) => new Promise((resolve) => setTimeout(resolve, ms)),
  sha256,
  retry_delays_ms: [400, 800, 1600, 3200, 6400, 12800],
}

/**
 * Sends a file and returns the server's verdict; `progress` is called with 0 to 1. A file whose
 * bytes are rides on the server is not sent; one that was not finished goes on where it stopped,
 * also after the page was loaded anew. `gate` is waited for before each part; what it throws ends
 * the sending.
 */
export async function uploadFile(
  file: File,
  progress: (share: number) => void,
  steps: UploadSteps = browser,
  gate: () => Promise<void> = () => Promise.resolve(),
): Promise<Upload> {
  const hash = await steps.sha256(file)
  const existing = hash && (await existingRides(hash, steps))
  if (existing) return existing
  const sending = await send(file, hash, progress, steps, gate)
  const upload = await verdict(new URL(sending.url ?? '', document.baseURI).pathname, steps)
  for (const { urlStorageKey } of await sending.findPreviousUploads())
    localStorage.removeItem(urlStorageKey)
  return upload
}

// What the same bytes became before, with no word of that being an upload of its own.
async function existingRides(hash: string, steps: UploadSteps): Promise<Upload | null> {
  const response = await checkedFetch(steps, `api/v1/uploads?sha256=${hash}`)
  const { items } = (await response.json()) as UploadList
  const first = items.find((upload) => upload.ride_ids.length > 0 && !upload.parts)
  if (!first) return null
  return { ...first, code: 'duplicate', detail: null, duplicate_of: first.ride_ids[0] ?? null }
}

// Resolves when the server has the file, or has read enough of it for a verdict.
async function send(
  file: File,
  hash: string | null,
  progress: (share: number) => void,
  steps: UploadSteps,
  gate: () => Promise<void>,
): Promise<Sending> {
  const { Upload } = await import('tus-js-client')
  let stopped: unknown
  const beforeRequest = async (request: HttpRequest) => {
    if (request.getMethod() !== 'PATCH') return
    try {
      await gate()
    } catch (reason) {
      stopped = reason
      throw reason
    }
  }
  return new Promise((resolve, reject) => {
    const sending = new Upload(file, {
      endpoint: new URL('api/v1/uploads', document.baseURI).href,
      chunkSize: CHUNK_BYTES,
      retryDelays: steps.retry_delays_ms,
      metadata: { filename: file.name, ...(hash && { sha256: hash }) },
      fingerprint: async () => hash ?? `${file.name} ${file.size} ${file.lastModified}`,
      ...(steps.http && { httpStack: steps.http }),
      onBeforeRequest: beforeRequest,
      onChunkComplete: (_, accepted, total) => progress(accepted / total),
      onShouldRetry: (error) => !stopped && mayResume(responseOf(error)?.getStatus() ?? 0),
      onSuccess: () => resolve(sending),
      onError: (error) => {
        if (stopped) reject(stopped)
        else if (responseOf(error)?.getStatus() === 422 && sending.url) resolve(sending)
        else reject(refused(error))
      },
    })
    sending.findPreviousUploads().then(([before]) => {
      if (before) sending.resumeFromPreviousUpload(before)
      sending.start()
    }, reject)
  })
}

function responseOf(error: Error | DetailedError): HttpResponse | null {
  return 'originalResponse' in error ? error.originalResponse : null
}

function refused(error: Error | DetailedError): Refusal {
  const response = responseOf(error)
  if (!response) return new Refusal(0, 'unreachable', error.message)
  return refusal(response.getStatus(), parsed(response.getBody()))
}

function parsed(text: string): unknown {
  try {
    return JSON.parse(text)
  } catch {
    return null
  }
}

async function verdict(address: string, steps: UploadSteps): Promise<Upload> {
  for (let poll = 0; poll < VERDICT_POLLS_MAX; poll++) {
    const upload = (await (await checkedFetch(steps, address)).json()) as Upload
    if (upload.state !== 'receiving' && upload.state !== 'queued') return upload
    await steps.wait(Math.min(1000, 100 * (poll + 1)))
  }
  throw new Refusal(0, 'unreachable', 'The server is still reading the file.')
}

async function checkedFetch(steps: UploadSteps, path: string): Promise<Response> {
  let response: Response
  try {
    response = await steps.fetch(path)
  } catch (error) {
    throw new Refusal(0, 'unreachable', String(error))
  }
  if (response.ok) return response
  throw refusal(response.status, await response.json().catch(() => null))
}

// Only pages of this machine or over TLS may hash; a large file is known by name, size and time.
async function sha256(file: File): Promise<string | null> {
  if (!globalThis.crypto?.subtle || file.size > HASHED_BYTES_MAX) return null
  const digest = await crypto.subtle.digest('SHA-256', await file.arrayBuffer())
  return [...new Uint8Array(digest)].map((byte) => byte.toString(16).padStart(2, '0')).join('')
}

function mayResume(status: number): boolean {
  return status === 0 || status >= 500 || status === 409
}

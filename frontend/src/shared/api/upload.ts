// One file to the server by tus 1.0: resumes where the server says it stands, then waits for the
// verdict.
import { Refusal, refusal } from './client'
import type { Upload, UploadList } from './types'

const CHUNK_BYTES = 1 << 20
const HASHED_BYTES_MAX = 64 << 20
const RETRIES_MAX = 6
const VERDICT_POLLS_MAX = 600

/** Where unfinished files stand, by what they are: kept while the page is loaded anew. */
export type Places = Pick<Storage, 'getItem' | 'setItem' | 'removeItem'>

export interface UploadSteps {
  fetch: typeof fetch
  wait: (ms: number) => Promise<void>
  sha256: (file: File) => Promise<string | null>
  places: Places
}

/** Whoever sends does not want to any more. */
export class Stopped extends Error {}

const browser: UploadSteps = {
  fetch: (...request) => fetch(...request),
  wait: (ms) => new Promise((resolve) => setTimeout(resolve, ms)),
  sha256,
  get places() {
    return localStorage
  },
}

/**
 * Sends a file and returns the server's verdict; `progress` is called with 0 to 1. A file whose
 * bytes are rides on the server is not sent; one that was not finished goes on where it stood.
 * `gate` is waited for before each part; what it throws ends the sending.
 */
export async function uploadFile(
  file: File,
  progress: (share: number) => void,
  steps: UploadSteps = browser,
  gate: () => Promise<void> = () => Promise.resolve(),
): Promise<Upload> {
  const hash = await steps.sha256(file)
  const known = hash && (await knownRides(hash, steps))
  if (known) return known
  const place = `spindle.upload.${hash ?? `${file.name} ${file.size} ${file.lastModified}`}`
  const begin = await begun(file, hash, place, steps)
  const { address } = begin
  let { offset } = begin
  let failures = 0
  while (offset < file.size) {
    await gate()
    try {
      offset = await append(address, file, offset, steps)
      failures = 0
      progress(offset / file.size)
    } catch (error) {
      // Its first bytes showed that it is no ride: the verdict is there, and the rest stays here.
      if (error instanceof Refusal && error.status === 422) break
      if (!mayResume(error) || ++failures > RETRIES_MAX) throw error
      await steps.wait(200 * 2 ** failures)
      offset = await offsetOf(address, offset, steps)
    }
  }
  const upload = await verdict(address, steps)
  steps.places.removeItem(place)
  return upload
}

// What the same bytes became before, with no word of that being an upload of its own.
async function knownRides(hash: string, steps: UploadSteps): Promise<Upload | null> {
  const response = await ask(steps, `api/v1/uploads?sha256=${hash}`, {})
  const { items } = (await response.json()) as UploadList
  const first = items.find((upload) => upload.ride_ids.length > 0 && !upload.parts)
  if (!first) return null
  return { ...first, code: 'duplicate', detail: null, duplicate_of: first.ride_ids[0] ?? null }
}

async function begun(
  file: File,
  hash: string | null,
  place: string,
  steps: UploadSteps,
): Promise<{ address: string; offset: number }> {
  const before = steps.places.getItem(place)
  if (before) {
    try {
      const headers = { 'Tus-Resumable': '1.0.0' }
      const { headers: stands } = await ask(steps, before, { method: 'HEAD', headers })
      if (Number(stands.get('upload-length')) === file.size) {
        return { address: before, offset: Number(stands.get('upload-offset')) }
      }
    } catch (error) {
      // It is gone: given up, or its time is over.
      if (!(error instanceof Refusal) || error.status === 0) throw error
    }
  }
  const address = await create(file, hash, steps)
  steps.places.setItem(place, address)
  return { address, offset: 0 }
}

async function create(file: File, hash: string | null, steps: UploadSteps): Promise<string> {
  const declared = hash ? `,sha256 ${base64(hash)}` : ''
  const response = await ask(steps, 'api/v1/uploads', {
    method: 'POST',
    headers: {
      'Tus-Resumable': '1.0.0',
      'Upload-Length': String(file.size),
      'Upload-Metadata': `filename ${base64(file.name)}${declared}`,
    },
  })
  const address = response.headers.get('location')
  if (!address) throw new Refusal(response.status, 'error', 'The server gave no upload address.')
  return new URL(address, location.origin).pathname
}

async function append(
  address: string,
  file: File,
  offset: number,
  steps: UploadSteps,
): Promise<number> {
  const response = await ask(steps, address, {
    method: 'PATCH',
    headers: {
      'Tus-Resumable': '1.0.0',
      'Upload-Offset': String(offset),
      'Content-Type': 'application/offset+octet-stream',
    },
    body: file.slice(offset, offset + CHUNK_BYTES),
  })
  return Number(response.headers.get('upload-offset'))
}

// The answer to a failed PATCH may be lost while its bytes arrived: only the server knows.
async function offsetOf(address: string, offset: number, steps: UploadSteps): Promise<number> {
  try {
    const headers = { 'Tus-Resumable': '1.0.0' }
    const response = await ask(steps, address, { method: 'HEAD', headers })
    return Number(response.headers.get('upload-offset'))
  } catch {
    return offset
  }
}

async function verdict(address: string, steps: UploadSteps): Promise<Upload> {
  for (let poll = 0; poll < VERDICT_POLLS_MAX; poll++) {
    const upload = (await (await ask(steps, address, {})).json()) as Upload
    if (upload.state !== 'receiving' && upload.state !== 'queued') return upload
    await steps.wait(Math.min(1000, 100 * (poll + 1)))
  }
  throw new Refusal(0, 'unreachable', 'The server is still reading the file.')
}

async function ask(steps: UploadSteps, path: string, init: RequestInit): Promise<Response> {
  let response: Response
  try {
    response = await steps.fetch(path, init)
  } catch (error) {
    throw new Refusal(0, 'unreachable', String(error))
  }
  if (response.ok) return response
  throw refusal(response.status, await response.json().catch(() => null))
}

// Only pages of this machine or over TLS may hash; a large file is told by name, size and time.
async function sha256(file: File): Promise<string | null> {
  if (!globalThis.crypto?.subtle || file.size > HASHED_BYTES_MAX) return null
  const digest = await crypto.subtle.digest('SHA-256', await file.arrayBuffer())
  return [...new Uint8Array(digest)].map((byte) => byte.toString(16).padStart(2, '0')).join('')
}

function mayResume(error: unknown): boolean {
  if (!(error instanceof Refusal)) return false
  return error.status === 0 || error.status >= 500 || error.status === 409
}

function base64(text: string): string {
  return btoa(String.fromCodePoint(...new TextEncoder().encode(text)))
}

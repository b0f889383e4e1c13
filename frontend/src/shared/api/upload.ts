// One file to the server by tus 1.0: resumes where the server says it stands, then waits for the
// verdict.
import { Refusal, refusal } from './client'
import type { Upload } from './types'

const CHUNK_BYTES = 1 << 20
const RETRIES_MAX = 6
const VERDICT_POLLS_MAX = 600

export interface UploadSteps {
  fetch: typeof fetch
  wait: (ms: number) => Promise<void>
}

const browser: UploadSteps = {
  fetch: (...request) => fetch(...request),
  wait: (ms) => new Promise((resolve) => setTimeout(resolve, ms)),
}

/** Sends a file and returns the server's verdict; `progress` is called with 0 to 1. */
export async function uploadFile(
  file: File,
  progress: (share: number) => void,
  steps: UploadSteps = browser,
): Promise<Upload> {
  const address = await create(file, steps)
  let offset = 0
  let failures = 0
  while (offset < file.size) {
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
  return verdict(address, steps)
}

async function create(file: File, steps: UploadSteps): Promise<string> {
  const response = await ask(steps, '/api/v1/uploads', {
    method: 'POST',
    headers: {
      'Tus-Resumable': '1.0.0',
      'Upload-Length': String(file.size),
      'Upload-Metadata': `filename ${base64(file.name)}`,
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

function mayResume(error: unknown): boolean {
  if (!(error instanceof Refusal)) return false
  return error.status === 0 || error.status >= 500 || error.status === 409
}

function base64(text: string): string {
  return btoa(String.fromCodePoint(...new TextEncoder().encode(text)))
}

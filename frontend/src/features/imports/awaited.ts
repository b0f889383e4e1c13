// Files that wait for what only their owner knows, also within an archive.
import type { FileServer } from '$shared/api/file_server'
import type { Upload } from '$shared/api/types'

const EVERY_MS = 500
const POLLS_MAX = 120

/** A file as soon as it is read, or how it stands after a minute. */
export async function onceRead(files: FileServer, id: string): Promise<Upload> {
  let upload = await files.upload(id)
  for (let polls = 0; upload.state === 'queued' && polls < POLLS_MAX; polls++) {
    await new Promise((resolve) => setTimeout(resolve, EVERY_MS))
    upload = await files.upload(id)
  }
  return upload
}

/** The latest of the files within an archive that has a code; null for none. */
export async function within(files: FileServer, id: string, code: string): Promise<Upload | null> {
  let cursor: string | undefined
  for (;;) {
    const listed = await files.parts(id, cursor)
    const match = listed.items.find((upload) => upload.code === code)
    if (match || listed.next === null) return match ?? null
    cursor = listed.next
  }
}

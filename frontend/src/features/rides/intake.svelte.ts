// Files on their way to becoming rides, one after the other, each with progress and verdict.
import type { Upload } from '$shared/api/types'
import { uploadFile } from '$shared/api/upload'

export interface Arrival {
  id: number
  name: string
  share: number
  upload: Upload | null
  trouble: string | null
}

const SHOWN_MAX = 50 // a folder of a thousand files must not become a thousand rows

export class Intake {
  arrivals = $state.raw<Arrival[]>([])
  private queue: { id: number; file: File }[] = []
  private next_id = 1
  private busy = false

  constructor(
    private readonly arrived: () => void,
    private readonly send: typeof uploadFile = uploadFile,
  ) {}

  /** Queues files; returns when nothing is left to do. */
  async take(files: File[]): Promise<void> {
    for (const file of files) {
      const id = this.next_id++
      this.queue.push({ id, file })
      const arrival = { id, name: file.name, share: 0, upload: null, trouble: null }
      this.arrivals = [arrival, ...this.arrivals].slice(0, SHOWN_MAX)
    }
    if (this.busy) return
    this.busy = true
    for (let job = this.queue.shift(); job; job = this.queue.shift()) await this.one(job)
    this.busy = false
  }

  /** Takes a file off the list. */
  forget(id: number): void {
    this.arrivals = this.arrivals.filter((arrival) => arrival.id !== id)
  }

  /** What became of a file that waited for its owner. */
  settle(upload: Upload): void {
    this.arrivals = this.arrivals.map((a) => (a.upload?.id === upload.id ? { ...a, upload } : a))
    this.arrived()
  }

  private async one({ id, file }: { id: number; file: File }): Promise<void> {
    try {
      const upload = await this.send(file, (share) => this.change(id, { share }))
      this.change(id, { upload, share: 1 })
      this.arrived()
    } catch (error) {
      this.change(id, { trouble: (error as Error).message })
    }
  }

  private change(id: number, change: Partial<Arrival>): void {
    this.arrivals = this.arrivals.map((a) => (a.id === id ? { ...a, ...change } : a))
  }
}

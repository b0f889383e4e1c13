// Files on their way to becoming rides: a few at once, each with its state, all with one summary.
import type { Upload } from '$shared/api/types'
import { Stopped, uploadFile } from '$shared/api/upload'
import { Refusal } from '$shared/api/client'

export type Standing =
  'waiting' | 'sending' | 'complete' | 'here' | 'partial' | 'rejected' | 'stopped'

export interface Arrival {
  id: number
  name: string
  size: number
  share: number
  standing: Standing
  upload: Upload | null
  problem: string | null
}

interface Job {
  id: number
  file: File
}

const AT_ONCE = 3 // the server reads two at once; the third is on its way meanwhile
const OVER: readonly Standing[] = ['complete', 'here', 'partial', 'rejected', 'stopped']

export class ImportQueue {
  arrivals = $state.raw<Arrival[]>([])
  paused = $state(false)
  /** Why it paused by itself. */
  problem = $state<string | null>(null)
  private queue: Job[] = []
  private next_id = 1
  private going = 0
  private stopping = false
  private wake: (() => void)[] = []
  private began_ms = 0
  private began_share = 0

  constructor(
    private readonly arrived: () => void,
    private readonly send: typeof uploadFile = uploadFile,
    private readonly now_ms: () => number = () => performance.now(),
  ) {}

  /** Queues files; returns when nothing is left to do. */
  async take(files: File[]): Promise<void> {
    if (files.length === 0) return
    if (!this.isGoing) {
      this.arrivals = []
      this.began_ms = this.now_ms()
      this.began_share = 0
      this.stopping = false
    }
    const fresh = files.map((file): [Job, Arrival] => {
      const id = this.next_id++
      const { name, size } = file
      const shown = { name: file.webkitRelativePath || name, size, share: 0 }
      const rest = { standing: 'waiting' as const, upload: null, problem: null }
      return [{ id, file }, { id, ...shown, ...rest }]
    })
    this.queue.push(...fresh.map(([job]) => job))
    this.arrivals = [...fresh.map(([, arrival]) => arrival).reverse(), ...this.arrivals]
    const free = Math.min(AT_ONCE - this.going, this.queue.length)
    await Promise.all(Array.from({ length: free }, () => this.work()))
  }

  get isGoing(): boolean {
    return this.arrivals.some(({ standing }) => !OVER.includes(standing))
  }

  get count(): Record<Standing, number> {
    const none = { waiting: 0, sending: 0, stopped: 0 }
    const count = { ...none, complete: 0, here: 0, partial: 0, rejected: 0 }
    for (const { standing } of this.arrivals) count[standing]++
    return count
  }

  get done(): number {
    return this.arrivals.filter(({ standing }) => OVER.includes(standing)).length
  }

  /** How much of all bytes is done with, 0 to 1. */
  get share(): number {
    const total = this.arrivals.reduce((sum, { size }) => sum + weight(size), 0)
    return total > 0 ? this.weightDone / total : 0
  }

  /** Seconds to the end at the speed so far; null while unknown. */
  get left_s(): number | null {
    const spent_s = (this.now_ms() - this.began_ms) / 1000
    const gone = this.share - this.began_share
    if (this.paused || gone < 0.02 || spent_s < 1) return null
    return (spent_s * (1 - this.share)) / gone
  }

  pause(): void {
    this.paused = true
  }

  resume(): void {
    this.paused = false
    this.problem = null
    // The time of the pause is none of the speed.
    this.began_ms = this.now_ms()
    this.began_share = this.share
    for (const wake of this.wake.splice(0)) wake()
  }

  /** Leaves what is not sent. What is on the server stays; a file chosen again goes on there. */
  stop(): void {
    this.stopping = true
    this.queue = []
    for (const { id, standing } of this.arrivals) {
      if (standing === 'waiting') this.change(id, { standing: 'stopped' })
    }
    this.resume()
  }

  /** What became of a file that waited for its owner. */
  settle(upload: Upload): void {
    const changed = { upload, standing: standingOf(upload) }
    for (const arrival of this.arrivals) {
      if (arrival.upload?.id === upload.id) this.change(arrival.id, changed)
    }
    this.arrived()
  }

  /** Takes a file off the list. */
  forget(id: number): void {
    this.arrivals = this.arrivals.filter((arrival) => arrival.id !== id)
  }

  private get weightDone(): number {
    return this.arrivals.reduce((sum, { size, share, standing }) => {
      return sum + weight(size) * (OVER.includes(standing) ? 1 : share)
    }, 0)
  }

  private async work(): Promise<void> {
    this.going++
    for (let job = this.queue.shift(); job; job = this.queue.shift()) await this.one(job)
    this.going--
  }

  private readonly gate = async (): Promise<void> => {
    while (this.paused) await new Promise<void>((resolve) => this.wake.push(resolve))
    if (this.stopping) throw new Stopped()
  }

  private async one(job: Job): Promise<void> {
    const { id, file } = job
    try {
      await this.gate()
      this.change(id, { standing: 'sending' })
      const progress = (share: number) => this.change(id, { share })
      const upload = await this.send(file, progress, undefined, this.gate)
      this.change(id, { upload, share: 1, standing: standingOf(upload) })
      this.arrived()
    } catch (error) {
      if (error instanceof Stopped) this.change(id, { standing: 'stopped' })
      else if (error instanceof Refusal && error.status === 0) this.wait(job, error.message)
      else this.change(id, { standing: 'rejected', problem: (error as Error).message })
    }
  }

  // The server is away: the file is not at fault, and the others would fare no better.
  private wait(job: Job, problem: string): void {
    this.change(job.id, { standing: 'waiting' })
    this.queue.unshift(job)
    this.problem = problem
    this.paused = true
  }

  private change(id: number, change: Partial<Arrival>): void {
    this.arrivals = this.arrivals.map((a) => (a.id === id ? { ...a, ...change } : a))
  }
}

export function standingOf(upload: Upload): Standing {
  if (upload.duplicate_of !== null || upload.code === 'duplicate') return 'here'
  const { state } = upload
  return state === 'receiving' || state === 'queued' ? 'sending' : state
}

// A small file costs its reading, whatever its size.
const weight = (size: number) => size + 50_000

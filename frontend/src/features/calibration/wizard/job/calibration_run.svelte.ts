// A calibration on show: the job as the server reports it, the sensor's reading several times a
// second, and one verb at a time. What is lost in transit is reported and requested again.
import { Refusal } from '$shared/api/client'
import { PollWhileVisible } from '$shared/context/poll_while_visible'
import type { CalibrationServer } from './calibration_server'
import type { Job, Reading } from './types'

const READING_MS = 300

export class CalibrationRun {
  job = $state.raw<Job>() as Job
  reading = $state.raw<Reading | null>(null)
  busy = $state(false)
  /** Why the last verb was refused. */
  refused = $state.raw<Refusal | null>(null)
  /** The server does not answer. */
  lost = $state(false)
  private readonly polling = new PollWhileVisible(() => this.poll(), READING_MS)

  constructor(
    job: Job,
    private readonly server: CalibrationServer,
  ) {
    this.job = job
  }

  start(): void {
    this.polling.start()
  }

  stop(): void {
    this.polling.stop()
  }

  /** Does one thing; whether it was done. A second one is refused while the first runs. */
  async act(verb: (server: CalibrationServer, id: number) => Promise<Job>): Promise<boolean> {
    if (this.busy) return false
    this.busy = true
    this.refused = null
    try {
      this.job = await verb(this.server, this.job.id)
      return true
    } catch (error) {
      if (!(error instanceof Refusal)) throw error
      this.refused = error
      // Whether it was done all the same is the server's to say.
      await this.again()
      return false
    } finally {
      this.busy = false
    }
  }

  /** The job as it is now; the last one stays while there is no answer. */
  private async again(): Promise<void> {
    try {
      this.job = await this.server.get(this.job.id)
      this.lost = false
    } catch (error) {
      if (!(error instanceof Refusal)) throw error
      this.lost = error.status === 0
    }
  }

  private async poll(): Promise<void> {
    if (this.job.state === 'closed') return
    const was_lost = this.lost
    try {
      this.reading = await this.server.reading(this.job.id)
      this.lost = false
    } catch (error) {
      if (!(error instanceof Refusal)) throw error
      this.lost = error.status === 0
      this.reading = null
      return
    }
    const moved = this.reading.device_id !== this.job.device_id
    if ((was_lost || moved) && !this.busy) await this.again()
  }
}

// How the rides of a unit used a table as it is edited. The newest question wins; it is sent
// once the points rest, because a drag changes it at every step and an answer reads whole rides.
import type { Refusal } from '$shared/api/client'
import { NewestAnswer } from '$shared/api/newest_answer.svelte'
import type { Server } from '$shared/api/server'
import type { TableUse, TableUseRequest } from '$shared/api/types'

const REST_MS = 400

export class TableUseQuestion {
  private readonly newest = new NewestAnswer<TableUse>()
  // Not read from the answer: an effect that requests would run again at every answer.
  private answered = false
  private device: string | null | undefined

  constructor(private readonly server: Server) {}

  /** Of the points requested last, or of the ones before until their answer is there. */
  get use(): TableUse | null {
    return this.newest.value
  }

  get problem(): Refusal | null {
    return this.newest.refusal
  }

  async request(question: TableUseRequest): Promise<void> {
    // The answer for another unit's rides is dropped.
    if (this.device !== question.device) {
      this.newest.value = null
      this.answered = false
    }
    this.device = question.device
    const rest_ms = this.answered ? REST_MS : 0
    await this.newest.request(async (signal) => {
      if (rest_ms) await new Promise((rested) => setTimeout(rested, rest_ms))
      signal.throwIfAborted()
      const use = await this.server.tableUse(question, signal)
      this.answered = true
      return use
    })
  }

  stop(): void {
    this.newest.stop()
  }
}

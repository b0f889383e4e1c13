// What the rides of a unit say about a table as it is edited. The newest question wins; it is asked
// once the points rest, because a drag asks at every step and an answer reads whole rides.
import { Refusal } from '$shared/api/client'
import type { Server } from '$shared/api/server'
import type { TableUse, TableUseRequest } from '$shared/api/types'

const REST_MS = 400

export class UseQuestion {
  /** Of the points asked for last, or while those are looked up of the ones before. */
  found = $state.raw<TableUse | null>(null)
  trouble = $state.raw<Refusal | null>(null)
  // Not read from `found`: whoever asks in an effect would ask again at every answer.
  private answered = false
  private device: string | null | undefined
  private asked = new AbortController()

  constructor(private readonly server: Server) {}

  async ask(question: TableUseRequest): Promise<void> {
    this.asked.abort()
    this.asked = new AbortController()
    const { signal } = this.asked
    // What another unit's rides say is not kept on show.
    if (this.device !== question.device) {
      this.found = null
      this.answered = false
    }
    this.device = question.device
    if (this.answered) await new Promise((rested) => setTimeout(rested, REST_MS))
    if (signal.aborted) return
    try {
      const found = await this.server.tableUse(question, signal)
      if (signal.aborted) return
      this.found = found
      this.trouble = null
      this.answered = true
    } catch (error) {
      if (signal.aborted) return
      if (!(error instanceof Refusal)) throw error
      this.trouble = error
    }
  }

  stop(): void {
    this.asked.abort()
  }
}

// One request after another to the server: the newest wins, and the answer before it stays on show
// until then. A refusal is stored as well; any other error is thrown.
import { Refusal } from './client'

export class NewestAnswer<Answer> {
  value = $state.raw<Answer | null>(null)
  refusal = $state.raw<Refusal | null>(null)
  running = $state(false)
  private controller = new AbortController()

  async request(send: (signal: AbortSignal) => Promise<Answer>): Promise<void> {
    this.stop()
    this.controller = new AbortController()
    const { signal } = this.controller
    this.running = true
    try {
      const answer = await send(signal)
      if (signal.aborted) return
      this.value = answer
      this.refusal = null
    } catch (error) {
      if (signal.aborted) return
      if (!(error instanceof Refusal)) throw error
      this.value = null
      this.refusal = error
    }
    this.running = false
  }

  /** Aborts the request and drops the answer: the question has changed. */
  forget(): void {
    this.stop()
    this.value = null
    this.refusal = null
  }

  /** Aborts the request; the answer stays. */
  stop(): void {
    this.controller.abort()
    this.running = false
  }
}

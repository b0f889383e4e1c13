// One question after another to the server: the newest wins, and the answer before it stays on show
// until then. A refusal is kept as well; what is no refusal is thrown.
import { Refusal } from './client'

export class NewestAnswer<Answer> {
  answer = $state.raw<Answer | null>(null)
  refusal = $state.raw<Refusal | null>(null)
  running = $state(false)
  private asked = new AbortController()

  async ask(question: (signal: AbortSignal) => Promise<Answer>): Promise<void> {
    this.stop()
    this.asked = new AbortController()
    const { signal } = this.asked
    this.running = true
    try {
      const answer = await question(signal)
      if (signal.aborted) return
      this.answer = answer
      this.refusal = null
    } catch (error) {
      if (signal.aborted) return
      if (!(error instanceof Refusal)) throw error
      this.answer = null
      this.refusal = error
    }
    this.running = false
  }

  /** Gives up what is asked and drops what was answered: the question is another one now. */
  forget(): void {
    this.stop()
    this.answer = null
    this.refusal = null
  }

  /** Gives up what is asked; what was answered stays. */
  stop(): void {
    this.asked.abort()
    this.running = false
  }
}

// A search for settings: begun, watched, given up. One at a time for a page.
import { Refusal } from '$shared/api/client'
import type { Server } from '$shared/api/server'
import type { Proposal, ProposalRequest } from '$shared/api/types'

const POLL_MS = 400
const RUNNING = ['waiting', 'riding', 'proving']

export class ProposalJob {
  job = $state.raw<Proposal | null>(null)
  refusal = $state.raw<Refusal | null>(null)
  requesting = $state(false)
  private timer: ReturnType<typeof setTimeout> | null = null
  // An answer counts only if no request was sent after it.
  private turn = 0
  private given_up = false

  constructor(private readonly server: Server) {}

  get running(): boolean {
    return this.requesting || (this.job !== null && RUNNING.includes(this.job.state))
  }

  async begin(question: ProposalRequest): Promise<void> {
    this.requesting = true
    this.given_up = false
    this.job = this.refusal = null
    await this.update(() => this.server.propose(question))
    this.requesting = false
    if (this.given_up) await this.cancel()
  }

  /** Also of a search the server has not named yet: it is given up as soon as it has a name. */
  async cancel(): Promise<void> {
    this.given_up = true
    const { job } = this
    if (job && this.running) await this.update(() => this.server.cancelProposal(job.id))
  }

  /** The page is left: the answer is no longer needed. */
  leave(): void {
    void this.cancel()
    if (this.timer) clearTimeout(this.timer)
    this.timer = null
  }

  private async update(send: () => Promise<Proposal>): Promise<void> {
    const turn = ++this.turn
    try {
      const job = await send()
      if (turn !== this.turn) return
      this.job = job
    } catch (error) {
      if (turn !== this.turn) return
      if (!(error instanceof Refusal)) throw error
      this.refusal = error
      this.job = null
    }
    if (this.timer) clearTimeout(this.timer)
    const { job } = this
    if (job && RUNNING.includes(job.state) && !this.given_up) {
      this.timer = setTimeout(() => void this.update(() => this.server.proposal(job.id)), POLL_MS)
    }
  }
}

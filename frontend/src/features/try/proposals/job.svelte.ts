// A search for settings: begun, watched, given up. One at a time for a page.
import { Refusal } from '$shared/api/client'
import type { Server } from '$shared/api/server'
import type { Proposal, ProposalRequest } from '$shared/api/types'

const LOOK_MS = 400
const RUNNING = ['waiting', 'riding', 'proving']

export class ProposalJob {
  job = $state.raw<Proposal | null>(null)
  refusal = $state.raw<Refusal | null>(null)
  asking = $state(false)
  private timer: ReturnType<typeof setTimeout> | null = null

  constructor(private readonly server: Server) {}

  get running(): boolean {
    return this.asking || (this.job !== null && RUNNING.includes(this.job.state))
  }

  async begin(question: ProposalRequest): Promise<void> {
    this.asking = true
    this.job = this.refusal = null
    await this.told(() => this.server.propose(question))
    this.asking = false
  }

  async cancel(): Promise<void> {
    const { job } = this
    if (job && this.running) await this.told(() => this.server.cancelProposal(job.id))
  }

  /** The page is left: nobody waits for the answer any more. */
  leave(): void {
    void this.cancel()
    if (this.timer) clearTimeout(this.timer)
    this.timer = null
  }

  private async told(ask: () => Promise<Proposal>): Promise<void> {
    try {
      this.job = await ask()
    } catch (error) {
      if (!(error instanceof Refusal)) throw error
      this.refusal = error
      this.job = null
    }
    if (this.timer) clearTimeout(this.timer)
    const { job } = this
    if (job && RUNNING.includes(job.state)) {
      this.timer = setTimeout(() => void this.told(() => this.server.proposal(job.id)), LOOK_MS)
    }
  }
}

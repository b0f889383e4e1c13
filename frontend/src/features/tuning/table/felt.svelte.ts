// What a rule comes to under the foot: torque at the crank for a push, as edited and as the unit
// has it, by the unit's own law on the server.
import { NewestAnswer } from '$shared/api/newest_answer.svelte'
import type { Server } from '$shared/api/server'
import type { TorqueSurface, TorqueSurfaceRequest } from '$shared/api/types'

export interface Felt {
  asked_nm: number
  given_nm: number
  /** Asked by what the unit has; null where no mode there runs by the table. */
  unit_asked_nm: number | null
}

export class FeltHere {
  private readonly newest = new NewestAnswer<Felt>()

  constructor(private readonly server: Server) {}

  get felt(): Felt | null {
    return this.newest.answer
  }

  /** One point of the draft and of the unit; unit: null where that has no such mode. */
  async ask(draft: TorqueSurfaceRequest, unit: TorqueSurfaceRequest | null): Promise<void> {
    await this.newest.ask(async (signal) => {
      const [here, there] = await Promise.all([
        this.server.torqueSurface(draft, signal),
        unit && this.server.torqueSurface(unit, signal),
      ])
      const first = (surface: TorqueSurface, of: 'asked_nm' | 'given_nm') =>
        surface[of][0]?.[0] ?? NaN
      return {
        asked_nm: first(here, 'asked_nm'),
        given_nm: first(here, 'given_nm'),
        unit_asked_nm: there && first(there, 'asked_nm'),
      }
    })
  }

  stop(): void {
    this.newest.stop()
  }
}

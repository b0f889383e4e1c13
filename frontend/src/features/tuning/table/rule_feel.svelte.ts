// What a rule feels like: the torque at the crank for a push, by the draft and by the unit's stored
// configuration, computed by the unit's own law on the server.
import { NewestAnswer } from '$shared/api/newest_answer.svelte'
import type { Server } from '$shared/api/server'
import type { TorqueSurfaceRequest } from '$shared/api/types'

export interface RuleFeel {
  demanded_nm: number
  delivered_nm: number
  /** Demanded by the unit's configuration; null where none of its modes uses the table. */
  unit_nm: number | null
}

const first = (rows: number[][]) => rows[0]?.[0] ?? NaN

export class RuleFeelPreview {
  private readonly newest = new NewestAnswer<RuleFeel>()

  constructor(private readonly server: Server) {}

  get feel(): RuleFeel | null {
    return this.newest.value
  }

  /** One point of the draft and of the unit; unit: null where that has no such mode. */
  async request(draft: TorqueSurfaceRequest, unit: TorqueSurfaceRequest | null): Promise<void> {
    await this.newest.request(async (signal) => {
      const [drafted, stored] = await Promise.all([
        this.server.torqueSurface(draft, signal),
        unit && this.server.torqueSurface(unit, signal),
      ])
      return {
        demanded_nm: first(drafted.demanded_nm),
        delivered_nm: first(drafted.delivered_nm),
        unit_nm: stored && first(stored.demanded_nm),
      }
    })
  }

  stop(): void {
    this.newest.stop()
  }
}

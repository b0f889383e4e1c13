// What a unit measures now, from its stream, and what the server sums up of it once a second.
import { Refusal } from '$shared/api/client'
import type { Server } from '$shared/api/server'
import type { Dashboard } from '$shared/api/types'
import { PollWhileVisible } from '$shared/context/poll_while_visible'
import { LiveStream } from '$shared/stream/live.svelte'

const PERIOD_MS = 1000
const KEPT = 61 // a minute
const CHANNELS = [
  'rider_torque_nm',
  'speed_kmh',
  'cadence_rpm',
  'motor_temperature_degc',
  'battery_soc_pct',
  'battery_voltage_v',
  'torque_age_ms',
  'assist_mode',
]

export class UnitNow {
  /** Null until the first answer, and while there is none: nothing old is shown. */
  dashboard = $state.raw<Dashboard | null>(null)
  /** The last minute, once a second; null where nobody told. */
  powers = $state.raw<{ at_s: number; rider_w: number | null; motor_w: number | null }[]>([])
  private readonly stream: LiveStream
  private readonly polling = new PollWhileVisible(() => this.look(), PERIOD_MS)

  constructor(
    private readonly server: Server,
    private readonly device_id: string,
  ) {
    this.stream = new LiveStream({ device_id, channels: CHANNELS, rate_hz: 2, window_s: 1 })
  }

  /** The newest values by channel; null while they are too old to look alive. */
  get channels(): Record<string, number | null> | null {
    return this.stream.stale ? null : this.stream.latest
  }

  start(): void {
    this.stream.open()
    this.polling.start()
  }

  stop(): void {
    this.polling.stop()
    this.stream.close()
  }

  private async look(): Promise<void> {
    try {
      this.dashboard = await this.server.dashboard(this.device_id)
    } catch (error) {
      if (!(error instanceof Refusal)) throw error
      this.dashboard = null
    }
    const { rider_power_w, motor_power_w } = this.dashboard ?? {}
    const now = {
      at_s: performance.now() / 1000,
      rider_w: rider_power_w ?? null,
      motor_w: motor_power_w ?? null,
    }
    this.powers = [...this.powers.slice(1 - KEPT), now]
  }
}

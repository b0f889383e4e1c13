// What a unit measures now, from its stream, and what the server sums up of it once a second.
import type { Server } from '$shared/api/server'
import type { Dashboard } from '$shared/api/types'
import { DashboardWatch } from '$shared/context/dashboard_watch.svelte'
import { LiveStream, type Instead } from '$shared/stream/live.svelte'

const SAMPLES_MAX = 61 // a minute
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
  /** The last minute, once a second; null where not reported. */
  powers = $state.raw<{ at_s: number; rider_w: number | null; motor_w: number | null }[]>([])
  private readonly stream: LiveStream
  private readonly summed: DashboardWatch

  constructor(server: Server, instead: Instead, device_id: string) {
    this.summed = new DashboardWatch(server, device_id, (values) => this.note(values))
    const options = { device_id, channels: CHANNELS, rate_hz: 2, window_s: 1 }
    this.stream = new LiveStream(options, instead)
  }

  get dashboard(): Dashboard | null {
    return this.summed.values
  }

  /** The newest values by channel; null while they are too old to count as live. */
  get channels(): Record<string, number | null> | null {
    return this.stream.stale ? null : this.stream.latest
  }

  start(): void {
    this.stream.open()
    this.summed.start()
  }

  stop(): void {
    this.summed.stop()
    this.stream.close()
  }

  private note(values: Dashboard | null): void {
    const now = {
      at_s: performance.now() / 1000,
      rider_w: values?.rider_power_w ?? null,
      motor_w: values?.motor_power_w ?? null,
    }
    this.powers = [...this.powers.slice(1 - SAMPLES_MAX), now]
  }
}

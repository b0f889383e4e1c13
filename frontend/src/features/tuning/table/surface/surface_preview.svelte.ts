// The surface and the findings of a table as it is edited, from the unit's own law on the server.
import { NewestAnswer } from '$shared/api/newest_answer.svelte'
import type { Server } from '$shared/api/server'
import type {
  FuzzyTable,
  LintReport,
  LintRequest,
  ParameterValue,
  TorqueSurface,
} from '$shared/api/types'

const GAIN_POINTS = 41
/** Each is a moment of the whole law: fewer, so that a drag is followed. */
const TORQUE_POINTS = 25

export interface GainSurface {
  speeds_kmh: number[]
  torque_rates: number[]
  gain: number[][]
}

export interface TorqueQuestion {
  parameters: Record<string, ParameterValue>
  mode: number
  rider_torque_nm: number
}

export class SurfacePreview {
  private readonly gains = new NewestAnswer<GainSurface>()
  private readonly torques = new NewestAnswer<TorqueSurface>()
  private readonly findings = new NewestAnswer<LintReport>()
  private current: LintRequest | null = null

  constructor(private readonly server: Server) {}

  get gain(): GainSurface | null {
    return this.gains.value
  }

  get torque(): TorqueSurface | null {
    return this.torques.value
  }

  /** Whether what is shown waits for the server: any other request would delay it. */
  get waiting(): boolean {
    return this.gains.running || this.torques.running
  }

  get lint(): LintReport | null {
    return this.findings.value
  }

  get problem(): string | null {
    const refused = this.gains.refusal ?? this.torques.refusal ?? this.findings.refusal
    return refused?.message ?? null
  }

  /** The surface comes first: the findings take the server longer, as they are proven. */
  async request(question: LintRequest): Promise<void> {
    this.current = question
    this.findings.stop()
    const table = question.fuzzy_table
    const { speeds_kmh, torque_rates } = grid(table, GAIN_POINTS)
    await this.gains.request(async (signal) => {
      const { gain } = await this.server.surface(table, speeds_kmh, torque_rates, signal)
      return { speeds_kmh, torque_rates, gain }
    })
    if (this.current !== question) return
    await this.findings.request((signal) => this.server.lint(question, signal))
  }

  /** What comes of the table at the crank, for a steady push in one of its modes. */
  async requestTorque(table: FuzzyTable, question: TorqueQuestion): Promise<void> {
    const current = { ...question, ...grid(table, TORQUE_POINTS) }
    await this.torques.request((signal) => this.server.torqueSurface(current, signal))
  }

  stop(): void {
    this.current = null
    for (const newest of [this.gains, this.torques, this.findings]) newest.stop()
  }
}

function grid(table: FuzzyTable, count: number) {
  const [speeds, rates] = [table.speed_points_kmh, table.torque_rate_points]
  return {
    speeds_kmh: spread(0, speeds[4] ?? 25, count),
    torque_rates: spread(rates[0] ?? 0, rates[4] ?? 1, count),
  }
}

/** `count` values from `from` to `to`, both included. */
function spread(from: number, to: number, count: number): number[] {
  return Array.from({ length: count }, (_, i) => from + ((to - from) * i) / (count - 1))
}

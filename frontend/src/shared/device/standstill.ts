// A unit takes a new configuration only while wheel and motor stand still. A simulated rider can be
// told to stop for it, and goes on afterwards.
import { RESTING_KMH, RESTING_MOTOR_RPM } from '$generated/registry'
import { Refusal } from '../api/client'
import type { Server } from '../api/server'

const POLL_MS = 250
const WAIT_MS_MAX = 90_000 // a coast-down from 25 km/h on the flat takes about a minute

export interface Pause {
  wait: (ms: number) => Promise<void>
}

/** Whether wheel and motor rest; stands is null where the unit does not report both. */
export interface Standstill {
  stands: boolean | null
  speed_kmh: number | null
}

const browser: Pause = { wait: (ms) => new Promise((resolve) => setTimeout(resolve, ms)) }

/** What a row of channels says about standing still. */
export function standstillOf(channels: Record<string, number | null>): Standstill {
  const { speed_kmh = null, motor_speed_rpm = null } = channels
  const turns = (value: number | null, most: number) =>
    value === null ? null : Math.abs(value) >= most
  const wheel = turns(speed_kmh, RESTING_KMH)
  const motor = turns(motor_speed_rpm, RESTING_MOTOR_RPM)
  if (wheel || motor) return { stands: false, speed_kmh }
  return { stands: wheel === null || motor === null ? null : true, speed_kmh }
}

/** Stops the simulated rider, acts once the bike stands, and lets the rider go on. */
export async function whileStanding<T>(
  server: Server,
  id: string,
  act: () => Promise<T>,
  pause: Pause = browser,
): Promise<T> {
  const before = await server.simulation(id)
  await server.setSimulation(id, { rider: { kind: 'off' }, brake: true })
  try {
    return await actOnceStanding(server, id, act, pause)
  } finally {
    const { kind, torque_nm, cadence_rpm_max } = before.rider
    const rider = { kind, torque_nm, cadence_rpm_max }
    const scenario = before.running ? { running: true } : {}
    await server.setSimulation(id, { rider, brake: before.brake, ...scenario })
  }
}

async function actOnceStanding<T>(
  server: Server,
  id: string,
  act: () => Promise<T>,
  pause: Pause,
): Promise<T> {
  for (let waited_ms = 0; ; waited_ms += POLL_MS) {
    const { stands } = standstillOf(await server.channels(id))
    // A unit that does not report its speed is not waited for: it checks itself whether it moves.
    if (stands !== false || waited_ms >= WAIT_MS_MAX) {
      try {
        return await act()
      } catch (error) {
        if (!movesStill(error) || waited_ms >= WAIT_MS_MAX) throw error
      }
    }
    await pause.wait(POLL_MS)
  }
}

/** Whether a refusal says that the wheel or the motor turns. */
export function movesStill(error: unknown): boolean {
  return error instanceof Refusal && error.code === 'not_standing_still'
}

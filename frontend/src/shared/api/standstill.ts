// A unit takes a new configuration only while wheel and motor stand still. A simulated rider can be
// asked to stop for it, and goes on afterwards.
import { Refusal } from './client'
import type { Server } from './server'

const POLL_MS = 250
const WAIT_MS_MAX = 90_000 // a coast-down from 25 km/h on the flat takes about a minute

export interface Pause {
  wait: (ms: number) => Promise<void>
}

const browser: Pause = { wait: (ms) => new Promise((resolve) => setTimeout(resolve, ms)) }

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
    const { speed_kmh, motor_speed_rpm } = await server.channels(id)
    const standing = Math.abs(speed_kmh ?? 0) < 0.05 && Math.abs(motor_speed_rpm ?? 0) < 1
    if (standing || waited_ms >= WAIT_MS_MAX) {
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

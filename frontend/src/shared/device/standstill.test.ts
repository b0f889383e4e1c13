/* Goal: a simulated rider stops for a write and goes on afterwards, whatever comes of the write. */
import { expect, it } from 'vitest'
import { Refusal } from '../api/client'
import type { Server } from '../api/server'
import type { SimulationChange } from '../api/types'
import { whileStanding } from './standstill'

const pause = { wait: async () => undefined }

/** A bike that loses 5 km/h between two polls once its rider stops. */
function rollingBike() {
  let speed_kmh = 20
  const changes: SimulationChange[] = []
  const server = {
    simulation: async () => ({
      running: true,
      brake: false,
      rider: { kind: 'legs', torque_nm: 24, cadence_rpm_max: 90 },
    }),
    setSimulation: async (_: string, change: SimulationChange) => changes.push(change),
    channels: async () => {
      speed_kmh = Math.max(0, speed_kmh - 5)
      return { speed_kmh, motor_speed_rpm: speed_kmh * 100 }
    },
  }
  return { server: server as unknown as Server, changes, speed: () => speed_kmh }
}

it('acts only once the bike stands, and lets the rider go on', async () => {
  const bike = rollingBike()

  const speed = await whileStanding(bike.server, 'unit', async () => bike.speed(), pause)

  expect(speed).toBe(0)
  expect(bike.changes[0]).toEqual({ rider: { kind: 'off' }, brake: true })
  expect(bike.changes.at(-1)).toEqual({
    rider: { kind: 'legs', torque_nm: 24, cadence_rpm_max: 90 },
    brake: false,
    running: true,
  })
})

it('lets the rider go on even when the unit refuses', async () => {
  const bike = rollingBike()
  const refuse = () => Promise.reject(new Refusal(422, 'out_of_range', 'no'))

  await expect(whileStanding(bike.server, 'unit', refuse, pause)).rejects.toThrow('no')
  expect(bike.changes.at(-1)?.rider?.kind).toBe('legs')
})

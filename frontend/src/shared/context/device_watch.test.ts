// A choice that is kept in a browser outlives the version that kept it.
import { describe, expect, it } from 'vitest'
import type { Server } from '../api/server'
import type { Device } from '../api/types'
import { DeviceWatch } from './device_watch.svelte'

function device(id: string, serial_number: string | null): Device {
  return { id, state: 'ready', identity: { serial_number } } as Device
}

async function watching(kept: string | null): Promise<DeviceWatch> {
  const items = [device('sim', null), device('sim-two', '0042')]
  const watch = new DeviceWatch({ devices: async () => items } as unknown as Server, kept)
  await watch.refresh()
  return watch
}

describe('the chosen unit', () => {
  it('is found by the id of its connection', async () => {
    expect((await watching('sim-two')).current?.id).toBe('sim-two')
  })

  it('is found by the serial number that an earlier version kept, and kept by its id', async () => {
    const watch = await watching('0042')

    expect([watch.current?.id, watch.chosen_id]).toEqual(['sim-two', 'sim-two'])
  })

  it('is nobody in particular while nobody chose, though a unit has no serial number', async () => {
    expect((await watching(null)).chosen_id).toBeNull()
  })
})

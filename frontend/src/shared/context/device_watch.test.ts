// A choice that is stored in a browser outlives the version that stored it.
import { describe, expect, it } from 'vitest'
import type { Server } from '../api/server'
import type { Device } from '../api/types'
import { DeviceWatch } from './device_watch.svelte'

function device(id: string, serial_number: string | null): Device {
  return { id, state: 'ready', identity: { serial_number } } as Device
}

async function watching(stored: string | null): Promise<DeviceWatch> {
  const items = [device('sim', null), device('sim-two', '0042')]
  const watch = new DeviceWatch({ devices: async () => items } as unknown as Server, stored)
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

  it('is none while none is chosen, even if a unit has no serial number', async () => {
    expect((await watching(null)).chosen_id).toBeNull()
  })
})

describe('a unit that is plugged into another port', () => {
  it('stays the chosen one', async () => {
    const at = (id: string, unit_key: string) => ({ ...device(id, null), unit_key })
    let items = [at('bench', 'ebl:22'), at('usb0', 'ebl:11')]
    const watch = new DeviceWatch({ devices: async () => items } as unknown as Server, 'usb0')
    await watch.refresh()
    items = [at('bench', 'ebl:22'), at('usb1', 'ebl:11')]
    await watch.refresh()

    expect([watch.current?.id, watch.chosen_id, watch.replacements]).toEqual(['usb1', 'usb1', 0])
  })
})

describe('another unit in the place of the one that was there', () => {
  const devices = (unit_key: string | null) => [{ ...device('cable', null), unit_key }]

  async function seeing(...keys: (string | null)[]): Promise<DeviceWatch> {
    let items: Device[] = []
    const watch = new DeviceWatch({ devices: async () => items } as unknown as Server, null)
    for (const key of keys) {
      items = devices(key)
      await watch.refresh()
    }
    return watch
  }

  it('is recorded with the unit that was there, and every time', async () => {
    const watch = await seeing('ebl:11', 'ebl:22', 'ebl:33')

    expect(watch.replaced?.unit_key).toBe('ebl:22')
    expect(watch.replacements).toBe(2)
    expect(watch.keyOf('cable')).toBe('ebl:33')
  })

  it('is no news once the first is back', async () => {
    const watch = await seeing('ebl:11', 'ebl:22', 'ebl:11')

    expect([watch.replaced, watch.replacements]).toEqual([null, 2])
  })

  it.each([
    [null, 'ebl:11'],
    ['ebl:11', 'ebl:11'],
    ['bare:url:socket://cable:1', 'bare:name:Commuter'],
  ])('is not seen where %s is followed by %s', async (before, now) => {
    const watch = await seeing(before, now)

    expect([watch.replaced, watch.replacements]).toEqual([null, 0])
  })
})

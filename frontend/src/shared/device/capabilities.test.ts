/* Goal: what a unit cannot do is not offered; where there is no unit, nothing is denied. */
import { describe, expect, it } from 'vitest'
import type { Device } from '../api/types'
import { can, hasPage, missingFor } from './capabilities'

const unit = (...capabilities: string[]) => ({ id: 'a', capabilities }) as unknown as Device

describe('a unit that lists what it can do', () => {
  const plain = unit('read_config', 'write_config', 'limits')

  it('can do that and nothing else', () => {
    expect([can(plain, 'write_config'), can(plain, 'logs')]).toEqual([true, false])
  })

  it('has the pages whose needs it meets', () => {
    expect(hasPage(plain, 'tune')).toBe(true)
    expect(hasPage(plain, 'live')).toBe(false)
    expect(hasPage(plain, 'sensor')).toBe(false)
  })

  it('has every page that needs no unit', () => {
    const pages = ['bike', 'rides', 'service', 'settings']

    expect(pages.filter((page) => hasPage(plain, page))).toEqual(pages)
  })

  it('is distinguished by the first thing that a page lacks', () => {
    expect(missingFor(unit('stream'), 'sensor')).toBe('rider_torque')
    expect(missingFor(unit('rider_torque'), 'sensor')).toBe('stream')
    expect(missingFor(unit('rider_torque', 'stream'), 'sensor')).toBeNull()
  })
})

it('is not checked where there is no unit', () => {
  expect(can(null, 'logs')).toBe(true)
  expect(missingFor(null, 'live')).toBeNull()
})

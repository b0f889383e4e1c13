/* Goal: faults of both halves are one number; what the unit did not send is not taken for none. */
import { expect, it } from 'vitest'
import { faultFlags, flagNames } from './flags'

it('joins the two channels of faults', () => {
  expect(faultFlags({ fault_flags: 5, fault_flags_high: 3 })).toBe(0x30005)
  expect(faultFlags({ fault_flags: 0, fault_flags_high: 2 ** 14 })).toBe(2 ** 30)
})

it('reads a unit of earlier firmware, which has only the first', () => {
  expect(faultFlags({ fault_flags: 5 })).toBe(5)
  expect(faultFlags({ fault_flags: 5, fault_flags_high: null })).toBe(5)
})

it('says nothing where nothing was sent', () => {
  expect([faultFlags({}), faultFlags({ fault_flags: null })]).toEqual([null, null])
  expect(flagNames('fault_flags', null)).toEqual([])
})

it('names what is set', () => {
  expect(flagNames('fault_flags', 0b110)).toEqual(['speed_sensor', 'battery_low'])
})

// @vitest-environment happy-dom
/* Goal: what recorded a ride is named in words where the file has words, and never guessed. */
import { expect, it } from 'vitest'
import type { Say } from './words'
import { deviceLine, deviceName, wordOf } from './instruments'

const say: Say = (key, values) => [key, ...Object.values(values ?? {})].join(' ')
const nothing = {
  kind: null,
  maker: null,
  product: null,
  serial_number: null,
  software_version: null,
  battery_v: null,
  battery_status: null,
}

it('names maker and product, but no product that is a number alone', () => {
  expect(deviceName({ ...nothing, maker: 'wahoo_fitness', product: 'ELEMNT' })).toBe(
    'wahoo fitness ELEMNT',
  )
  expect(deviceName({ ...nothing, maker: 'garmin', product: '3121' })).toBe('garmin')
  expect(deviceName(nothing)).toBe('')
})

it('shows serial number and battery where they are known', () => {
  const device = { ...nothing, serial_number: '77', battery_status: 'low' }
  expect(deviceLine(device, say)).toBe('serial 77 · battery state_low')
  expect(deviceLine({ ...nothing, battery_status: 'status_0' }, say)).toBe('')
})

it('keeps a word of the file that we have none for', () => {
  expect(wordOf(say, 'sport', 'cycling')).toBe('sport_cycling')
  expect(wordOf(say, 'sport', 'rock_climbing')).toBe('rock climbing')
})

/* Goal: a page knows its place wherever a proxy has put the server. */
import { expect, it } from 'vitest'
import { placeOf } from './place'

it.each([
  ['/', '/', ''],
  ['/rides/7', '/', 'rides/7'],
  ['/spindle/', '/spindle/', ''],
  ['/spindle', '/spindle/', ''],
  ['/spindle/rides/7', '/spindle/', 'rides/7'],
  // Past the proxy, which is the only one who says /spindle.
  ['/rides/7', '/spindle/', 'rides/7'],
  ['/', '/spindle/', ''],
  ['/spindles', '/spindle/', 'spindles'],
])('%s below %s is %s', (path, root, place) => {
  expect(placeOf(path, root)).toBe(place)
})

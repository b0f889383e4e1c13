/* Goal: what is typed is classified as the server reads it (backend/device/link/opening.py). */
import { expect, it } from 'vitest'
import { addressKind, newSimulated } from './address'

it.each([
  ['', null],
  ['sim', 'simulated'],
  ['sim:one?seed=1', 'simulated'],
  ['/dev/ttyUSB0', 'serial'],
  [' COM3 ', 'serial'],
  ['simulator', 'serial'],
  ['socket://192.0.2.7:7500', 'socket'],
  ['socket://[2001:db8::1]:7500', 'socket'],
  ['socket://bridge.local:7500?baud=115200', 'socket'],
  ['socket://192.0.2.7', 'socket_part'],
  ['socket://192.0.2.7:0', 'socket_part'],
  ['socket://192.0.2.7:70000', 'socket_part'],
  ['http://192.0.2.7', 'not_an_address'],
])('reads %j', (address, kind) => {
  expect(addressKind(address)).toBe(kind)
})

it('gives another simulated unit an address of its own, also after one was removed', () => {
  expect(newSimulated([])).toBe('sim:bench-1')
  expect(newSimulated(['sim:bench-1', '/dev/ttyUSB0', 'sim:bench-3'])).toBe('sim:bench-2')
})

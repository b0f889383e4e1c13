/* Goal: an address names one page, and an unknown one says so. */
import { expect, it } from 'vitest'
import { neededFor, readRoute } from './router.svelte'

it.each([
  ['', { page: 'bike', id: '' }],
  ['connect', { page: 'connect', id: '' }],
  ['live', { page: 'live', id: '' }],
  ['rides', { page: 'rides', id: '' }],
  ['rides/12', { page: 'ride', id: '12' }],
  ['rides/compare', { page: 'compare', id: '' }],
  ['rides/12/more', { page: 'unknown', id: '' }],
  ['fleet', { page: 'fleet', id: '' }],
  ['audit', { page: 'audit', id: '' }],
  ['audit/1', { page: 'unknown', id: '' }],
  ['fleet/12', { page: 'fleet_bike', id: '12' }],
  ['visits/7', { page: 'visit', id: '7' }],
  ['tune', { page: 'tune', id: '' }],
  ['tune/modes', { page: 'modes', id: '' }],
  ['tune/try', { page: 'try', id: '' }],
  ['tune/why', { page: 'why', id: '' }],
  ['tune/library', { page: 'library', id: '' }],
  ['tune/tune', { page: 'unknown', id: '' }],
  ['tune/other', { page: 'unknown', id: '' }],
  ['nonsense', { page: 'unknown', id: '' }],
])('%s', (path, route) => {
  expect(readRoute(path)).toEqual(route)
})

it('has a first page for riders, who have no unit', () => {
  expect(readRoute('', 'rides')).toEqual({ page: 'rides', id: '' })
  expect(['why', 'connect', 'rides', 'fleet'].filter((page) => neededFor(page as never))).toEqual([
    'why',
    'connect',
  ])
})

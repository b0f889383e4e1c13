/* Goal: the address of the rides says which bike, and keeps what else it says. */
import { expect, it } from 'vitest'
import { bikeIn, searchOf } from './bike_query'

it.each([
  [7, '', '?bike=7'],
  [7, '?words=alps', '?words=alps&bike=7'],
  [8, '?bike=7&words=alps', '?bike=8&words=alps'],
  [null, '?bike=7', ''],
  [null, '?words=alps', '?words=alps'],
])('is about bike %j after %j', (bike, before, search) => {
  expect(searchOf(bike, before)).toBe(search)
  expect(bikeIn(search)).toBe(bike)
})

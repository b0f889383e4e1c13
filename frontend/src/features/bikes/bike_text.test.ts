/* Goal: what is saved of a bike is what was changed and nothing else. */
import type { Bike } from '$shared/api/bike_server'
import { expect, it } from 'vitest'
import { changeOf, textOf } from './bike_text'

const bike = { name: 'City 7', model: 'Commuter', battery: null, mileage_km: 812 } as Bike

it('changes nothing that was not edited', () => {
  expect(changeOf(bike, textOf(bike))).toEqual({})
})

it('says what was typed, and takes away what was emptied', () => {
  const text = { ...textOf(bike), model: '', battery: '500 Wh' }

  expect(changeOf(bike, text)).toEqual({ model: null, battery: '500 Wh' })
})

/* Goal: between the lines of its grid a picture is what lies straight between their values. */
import { expect, it } from 'vitest'
import { columnAt, heightAt, rowAt } from './between'
import type { Picture } from './surface_shown'

const picture: Picture = {
  shown: 'delivered_nm',
  speeds_kmh: [0, 10],
  torque_rates: [0, 0.5],
  z: [
    [20, 40],
    [0, 0],
  ],
  top: 60,
  unit: 'Nm',
  demanded: null,
  taken_by: null,
}

it('cuts between the lines of its grid', () => {
  expect(rowAt(picture.z, picture.speeds_kmh, 5)).toEqual([10, 20])
  expect(columnAt(picture.z, picture.torque_rates, 0.25)).toEqual([30, 0])
  expect(columnAt(picture.z, picture.torque_rates, 9)).toEqual([40, 0])
})

it('is between four places what their mean is', () => {
  expect(heightAt(picture, { speed_kmh: 5, torque_rate: 0.25 })).toBe((20 + 40) / 4)
})

/* Goal: a moment and a place of an axis belong to each other, also where the bike stands. */
import { expect, it } from 'vitest'
import { Locale } from '$shared/i18n/locale.svelte'
import { Units } from '$shared/units/units.svelte'
import type { Series } from '$shared/api/series'
import { axisTicks, LaidAxis } from './trace_axis'

// 100 s at 10 m/s, a light of 50 s, 100 s at 5 m/s.
const distance = new LaidAxis('distance', [0, 100, 150, 250], [0, 1000, 1000, 1500])

it('stands while the bike does, and finds the moment it came to a place', () => {
  expect([distance.at(50), distance.at(120), distance.at(200)]).toEqual([500, 1000, 1250])
  expect([500, 1000, 1250].map((at_m) => distance.moment(at_m))).toEqual([50, 100, 200])
})

it('ends where the ride does', () => {
  expect([distance.at(-5), distance.at(900)]).toEqual([0, 1500])
  expect([distance.moment(-5), distance.moment(9000)]).toEqual([0, 250])
})

it('takes the rows of a series for more exact than its own points', () => {
  const series = {
    t_first_s: Float64Array.of(20, 30),
    t_last_s: Float64Array.of(29, 40),
    x_first: Float64Array.of(230, 300),
    x_last: Float64Array.of(299, 400),
  } as unknown as Series

  const finer = distance.refined(series)

  expect(finer.at(20)).toBe(230)
  expect(finer.at(0)).toBe(0)
  expect(finer.at(200)).toBe(1250)
})

it('names round kilometres, or miles', () => {
  const locale = new Locale()
  const metric = axisTicks(distance, 0, 1500, 3, new Units(locale, 'metric'))
  const imperial = axisTicks(distance, 0, 3200, 2, new Units(locale, 'imperial'))

  expect(metric.text).toEqual(['0.0 km', '0.5 km', '1.0 km', '1.5 km'])
  expect(imperial.text).toEqual(['0 mi', '1 mi'])
  expect(imperial.at[1]).toBeCloseTo(1609.34, 0)
})

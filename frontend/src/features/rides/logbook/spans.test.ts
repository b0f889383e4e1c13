import { describe, expect, it } from 'vitest'
import type { PeriodTotals } from '$shared/api/types'
import { heights, lacking, weekBegins } from './spans'

const period = (change: Partial<PeriodTotals>): PeriodTotals => ({
  first_day: '2026-07-13',
  from: '2026-07-12T23:00:00Z',
  to: '2026-07-19T23:00:00Z',
  rides: 0,
  with_rider: 0,
  with_motor: 0,
  distance_km: null,
  moving_s: null,
  rider_wh: null,
  rider_power_w_mean: null,
  motor_wh: null,
  ...change,
})

describe('weeks', () => {
  it('have bars against the highest, and none where nothing is known', () => {
    const some = [period({ distance_km: 20 }), period({}), period({ distance_km: 40 })]
    expect(heights(some, 'distance_km')).toEqual([50, null, 100])
    expect(heights(some, 'motor_wh')).toEqual([null, null, null])
  })

  it('show which motor totals are not of all rides', () => {
    const all = period({ rides: 2 })
    const some = period({ rides: 3, with_motor: 2, motor_wh: 5 })
    expect(lacking([period({}), all, some])).toEqual([
      { period: all, kind: 'all', count: 2 },
      { period: some, kind: 'some', count: 1 },
    ])
  })

  it('begin when the reader is used to it', () => {
    expect(weekBegins('de-DE')).toBe(1)
    expect(weekBegins('en-US')).toBe(7)
  })
})

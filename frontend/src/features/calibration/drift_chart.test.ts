/* Goal: rides stand by time and zero, levels only where they are in range, colours by temperature,
   and a picture of nothing is still one. */
import { expect, it } from 'vitest'
import type { SensorDrift } from '$shared/api/types'
import { MARGIN, pictureOf, TALL } from './drift_chart'

const NOW = Date.parse('2026-07-01T00:00:00Z')
const WIDTH = 600

const ride = (day: string, zero_nm: number | null, degc: number | null = 20) => ({
  ride_id: Number(day.slice(8)),
  started_at: `${day}T00:00:00Z`,
  zero_nm,
  uncertainty_nm: zero_nm === null ? null : 0.02,
  zero_counts: null,
  temperature_degc: degc,
  pieces: 5,
  reason: zero_nm === null ? ('no_coasting' as const) : null,
  left_out: null,
})

const drift = (changed: Partial<SensorDrift> = {}): SensorDrift => ({
  unit_key: 'ebl:SP-1',
  method: 1,
  watch_nm: 1,
  act_nm: 3,
  level: 'ok',
  latest: null,
  rides: [],
  calibrations: [],
  no_trend: 'few_rides',
  trend: null,
  ...changed,
})

it('sets rides from the first at the left to today at the right', () => {
  const rides = [ride('2026-06-16', 0.5), ride('2026-06-08', null), ride('2026-06-01', 0)]
  const { dots, today_x } = pictureOf(drift({ rides }), WIDTH, NOW)

  expect(dots.map((dot) => dot.ride_id)).toEqual([16, 1])
  expect(dots[1]?.x).toBe(MARGIN.left)
  expect(dots[0]?.x).toBeCloseTo((MARGIN.left + WIDTH - MARGIN.right) / 2)
  expect(today_x).toBe(WIDTH - MARGIN.right)
  expect(dots[0]?.y).toBeLessThan(dots[1]?.y ?? 0)
})

it('shows the level of action only once the zero comes near', () => {
  const near = pictureOf(drift({ rides: [ride('2026-06-01', 2.9)] }), WIDTH, NOW)
  const far = pictureOf(drift({ rides: [ride('2026-06-01', 0.1)] }), WIDTH, NOW)

  expect(near.levels.map(({ nm }) => nm)).toEqual([0, 1, -1, 3])
  expect(far.levels.map(({ nm }) => nm)).toEqual([0, 1, -1])
})

it('is bluest at the coldest, reddest at the warmest, and colourless without a thermometer', () => {
  const rides = [ride('2026-06-03', 0, null), ride('2026-06-02', 0, 30), ride('2026-06-01', 0, -5)]
  const { dots, coldest_degc, warmest_degc } = pictureOf(drift({ rides }), WIDTH, NOW)

  expect(dots.map((dot) => dot.colour)).toEqual([null, 'rgb(178 24 43)', 'rgb(33 102 172)'])
  expect([coldest_degc, warmest_degc]).toEqual([-5, 30])
})

it('sets a ride that lies apart at the edge, and the others keep their room', () => {
  const foot = { ...ride('2026-06-16', 6), left_out: 'apart' as const }
  const { dots, levels } = pictureOf(drift({ rides: [foot, ride('2026-06-01', 0)] }), WIDTH, NOW)

  expect([dots[0]?.y, dots[0]?.counts]).toEqual([MARGIN.top, false])
  expect(levels.map(({ nm }) => nm)).toEqual([0, 1, -1])
})

it('leaves calibrations of before the first ride out', () => {
  const mark = (seq: number, day: string) => ({
    seq,
    created_at: `${day}T00:00:00Z`,
    author: '',
    reason: '',
    changed: [],
  })
  const calibrations = [mark(2, '2026-05-01'), mark(3, '2026-06-15')]
  const picture = pictureOf(drift({ rides: [ride('2026-06-01', 0)], calibrations }), WIDTH, NOW)

  expect(picture.calibrations.map(({ seq }) => seq)).toEqual([3])
})

it('draws nothing of no ride', () => {
  const { dots, bands, levels, coldest_degc } = pictureOf(drift(), 0, NOW)

  expect([dots, bands, coldest_degc]).toEqual([[], [], null])
  expect(levels[0]?.y).toBeCloseTo((TALL + MARGIN.top - MARGIN.bottom) / 2)
})

it('names a day once', () => {
  const { dates } = pictureOf(drift({ rides: [ride('2026-06-29', 0)] }), WIDTH, NOW)
  const days = dates.map(({ at_ms }) => new Date(at_ms).toISOString().slice(0, 10))

  expect(days).toEqual(['2026-06-29', '2026-06-30'])
})

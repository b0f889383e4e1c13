/* Goal: a track is drawn true at its latitude, wherever it lies, open in gaps. */
import { expect, it } from 'vitest'
import type { Track } from '$shared/api/types'
import { scaleLength, TrackShape } from './track_shape'

const SIZE = [440, 300, 20] as const
const track = (places: ([number, number] | null)[], distance_m: number[] | null = null): Track => ({
  t_s: places.map((_, i) => 10 * i),
  moving_s: null,
  distance_m,
  latitude_deg: places.map((place) => place?.[0] ?? null),
  longitude_deg: places.map((place) => place?.[1] ?? null),
})
const drawn = (one: Track) => {
  const shape = TrackShape.of(one, ...SIZE)
  if (!shape) throw new Error('There is a track.')
  return shape
}

it('draws a square of ground as a square, north up', () => {
  // 0.01 degree of latitude and, at 60 north where the cosine is a half, 0.02 of longitude.
  const shape = drawn(track([[60, 10], [60.01, 10], [60.01, 10.02], [60, 10.02]]))

  const [a, b, c] = [shape.at(0), shape.at(10), shape.at(20)]
  if (!a || !b || !c) throw new Error('There are positions.')
  expect(b.y).toBeLessThan(a.y)
  expect(b.x).toBeCloseTo(a.x)
  expect((c.x - b.x) / (a.y - b.y)).toBeCloseTo(1, 3)
  // 0.01 degree is 1112 m, and fills the height.
  expect(shape.m_per_px).toBeCloseTo(1112 / 260, 1)
})

it('goes on over the antimeridian', () => {
  const here = drawn(track([[0, 0], [0, 0.01], [0.01, 0.01]]))
  const shifted = drawn(track([[0, 179.995], [0, -179.995], [0.01, -179.995]]))

  expect(shifted.m_per_px).toBeCloseTo(here.m_per_px, 6)
  expect(shifted.at(10)?.x).toBeCloseTo(here.at(10)?.x ?? 0, 3)
})

it('leaves a gap open, and has no place in it', () => {
  const shape = drawn(track([[0, 0], [0, 0.01], null, [0, 0.02], [0, 0.03]]))

  expect(shape.at(20)).toBeNull()
  expect(shape.segments([]).map(({ points }) => points.length)).toEqual([2, 2])
})

it('changes the line where the mode changes', () => {
  const shape = drawn(track([[0, 0], [0, 0.02]]))

  const segments = shape.segments([
    { from_s: 0, to_s: 4, mode: 1 },
    { from_s: 4, to_s: 10, mode: 3 },
  ])

  expect(segments.map(({ mode }) => mode)).toEqual([1, 3])
  const [begin, change] = [segments[0]?.points[0]?.x ?? 0, segments[0]?.points[1]?.x ?? 0]
  expect((change - begin) / (shape.end.x - begin)).toBeCloseTo(0.4)
})

it('puts marks at round kilometres of the way, and finds the moment of a place', () => {
  const one = track([[0, 0], [0, 0.1], [0, 0.2]], [0, 3000, 6000])
  const shape = drawn(one)

  expect(shape.marks(one, 1000).map(({ distance }) => distance)).toEqual([1, 2, 3, 4, 5])
  expect(shape.nearest({ x: 440, y: 150 })).toBe(20)
})

it('has no drawing without positions, and a round scale with them', () => {
  expect(TrackShape.of({ ...track([]), latitude_deg: null }, ...SIZE)).toBeNull()
  expect(scaleLength(10, 100, 1000)).toBe(1000)
  expect(scaleLength(7, 100, 1000)).toBe(500)
})

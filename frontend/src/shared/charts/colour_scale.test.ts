/* Goal: a value has the colour that the published scale gives it, and no other beyond its ends. */
import { expect, it } from 'vitest'
import { BLUE_TO_RED, colourAt, VIRIDIS } from './colour_scale'

it('is Viridis: the quarters that matplotlib prints for it', () => {
  const hex = [0, 0.25, 0.5, 0.75, 1].map((share) =>
    colourAt(VIRIDIS, share).map((part) => part.toString(16).padStart(2, '0')).join(''),
  )
  const published = ['440154', '3b528b', '21918c', '5ec962', 'fde725']
  const parts = (colour: string) => [0, 2, 4].map((at) => parseInt(colour.slice(at, at + 2), 16))

  // Between the stored colours it is a straight line, which the true scale is not quite.
  for (const [i, colour] of hex.entries()) {
    const off = parts(colour).map((part, k) => Math.abs(part - (parts(published[i] ?? '')[k] ?? 0)))
    expect(Math.max(...off)).toBeLessThanOrEqual(4)
  }
})

it('ends at its ends', () => {
  expect(colourAt(VIRIDIS, -3)).toEqual(colourAt(VIRIDIS, 0))
  expect(colourAt(VIRIDIS, 7)).toEqual(colourAt(VIRIDIS, 1))
})

it('is palest where nothing differs', () => {
  const light = (share: number) => colourAt(BLUE_TO_RED, share).reduce((sum, part) => sum + part)

  for (const share of [0, 0.3, 0.7, 1]) expect(light(share)).toBeLessThan(light(0.5))
})

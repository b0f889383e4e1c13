/* Goal: from every viewpoint the surface is complete within its frame, what is nearer is
painted later, and what is pointed at is what lies there. */
import { describe, expect, it } from 'vitest'
import { INITIAL_VIEW, Solid, turned, within, type Pixel } from './solid'

const TURNS = Array.from({ length: 24 }, (_, i) => (i * Math.PI) / 12 + 0.05)
const [WIDTH, HEIGHT, CELLS] = [640, 500, 6]

describe.each(TURNS)('turned by %f', (turn) => {
  const solid = new Solid({ turn, tilt: 0.6 }, WIDTH, HEIGHT)

  it('is wholly within its frame', () => {
    for (const corner of Array.from({ length: 8 }, (_, i) => i)) {
      const [left, top] = solid.at(corner & 1, (corner >> 1) & 1, corner >> 2)
      expect([left > 0, left < WIDTH, top > 0, top < HEIGHT]).toEqual([true, true, true, true])
    }
  })

  it('paints each cell once, and none after one that stands before it', () => {
    const seen = [...solid.cells(CELLS + 1, CELLS + 1)]
    expect(new Set(seen.map(String)).size).toBe(CELLS * CELLS)

    // On the floor what is lower on the screen is nearer.
    const lowness = ([row, column]: readonly [number, number]) =>
      solid.at((column + 0.5) / CELLS, (row + 0.5) / CELLS, 0)[1]
    for (const [i, later] of seen.entries()) {
      const inLine = seen.slice(0, i).filter(([r, c]) => r === later[0] || c === later[1])
      for (const before of inLine) expect(lowness(before)).toBeLessThan(lowness(later))
    }
  })

  it('has its farther sides higher on the screen', () => {
    const { x, y } = solid.far
    expect(solid.at(x, 0.5, 0)[1]).toBeLessThan(solid.at(1 - x, 0.5, 0)[1])
    expect(solid.at(0.5, y, 0)[1]).toBeLessThan(solid.at(0.5, 1 - y, 0)[1])
  })
})

it('stands as the map: x to the right, y towards the eye, values upwards', () => {
  const solid = new Solid(INITIAL_VIEW, WIDTH, HEIGHT)

  expect(solid.at(1, 0.5, 0)[0]).toBeGreaterThan(solid.at(0, 0.5, 0)[0])
  expect(solid.at(0.5, 1, 0)[1]).toBeGreaterThan(solid.at(0.5, 0, 0)[1])
  expect(solid.at(0.5, 0.5, 1)[1]).toBeLessThan(solid.at(0.5, 0.5, 0)[1])
})

it('is never seen from below nor from straight above', () => {
  expect(turned(INITIAL_VIEW, { turn: 0, tilt: 9 }).tilt).toBeLessThan(Math.PI / 2)
  expect(turned(INITIAL_VIEW, { turn: 0, tilt: -9 }).tilt).toBeGreaterThan(0)
})

it('knows what lies within four corners', () => {
  const corners: Pixel[] = [
    [0, 0],
    [10, 2],
    [12, 9],
    [1, 8],
  ]
  expect([within(corners, [5, 5]), within(corners, [11.5, 2])]).toEqual([true, false])
  expect([within(corners, [0.4, 8.5]), within(corners, [5, 0.5])]).toEqual([false, false])
})

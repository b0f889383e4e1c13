/* Goal: what is done to a block of rules is computed in gain and given in the nearest labels.

Expected labels are worked out by hand from the peaks 0.1, 0.2, 0.3, 0.4, 0.5. */
import { expect, it } from 'vitest'
import { interpolated, levelled, moved, nearestLabel, scaled, smoothed } from './block'
import { blockOf, type Rules } from './table'

const GAINS = [0.1, 0.2, 0.3, 0.4, 0.5]
const all = (label: Rules[number][number]): Rules =>
  Array.from({ length: 5 }, () => Array(5).fill(label))
const ALL_RULES = blockOf({ row: 0, column: 0 }, { row: 4, column: 4 })
const with_ = (rules: Rules, ...cells: [number, number, Rules[number][number]][]) =>
  rules.map((row, r) =>
    row.map((old, c) => cells.find(([at, on]) => at === r && on === c)?.[2] ?? old),
  )

it('takes the nearest label, and of two as near the one it has', () => {
  expect(nearestLabel(GAINS, 0.34, 'NB')).toBe('ZO')
  expect(nearestLabel(GAINS, 0.35, 'PB')).toBe('PS')
  expect(nearestLabel(GAINS, 0.35, 'ZO')).toBe('ZO')
  expect(nearestLabel(GAINS, 9, 'ZO')).toBe('PB')
})

it('levels a block at its mean and leaves the rest', () => {
  const rules = with_(all('ZO'), [0, 0, 'NB'], [0, 1, 'PB'], [1, 0, 'PB'], [1, 1, 'PB'])
  const block = blockOf({ row: 0, column: 0 }, { row: 1, column: 1 })

  const after = levelled(rules, block, GAINS) // a mean of 0.4

  expect(after).toEqual(with_(all('ZO'), [0, 0, 'PS'], [0, 1, 'PS'], [1, 0, 'PS'], [1, 1, 'PS']))
  expect(moved(rules, after)).toBe(4)
})

it('scales the gain, and says so where no label is nearer', () => {
  expect(scaled(all('ZO'), ALL_RULES, GAINS, 1.34)).toEqual(all('PS')) // 0.402
  expect(moved(all('ZO'), scaled(all('ZO'), ALL_RULES, GAINS, 1.1))).toBe(0) // 0.33 is ZO still
})

it('draws a line through the ends of a row and a plane through four corners', () => {
  const row = with_(all('ZO'), [2, 0, 'NB'], [2, 4, 'PB'])
  const line = blockOf({ row: 2, column: 4 }, { row: 2, column: 0 })
  expect(interpolated(row, line, GAINS)[2]).toEqual(['NB', 'NS', 'ZO', 'PS', 'PB'])

  const corners = with_(all('PB'), [0, 0, 'NB'], [0, 4, 'ZO'], [4, 0, 'ZO'], [4, 4, 'PB'])
  const plane = interpolated(corners, ALL_RULES, GAINS)
  // 0.2, 0.25, 0.3, 0.35, 0.4; what lies between two labels stays nearer to the PB it was.
  expect(plane[2]).toEqual(['NS', 'ZO', 'ZO', 'PS', 'PS'])
  expect(plane.map((cells) => cells[2])).toEqual(['NS', 'ZO', 'ZO', 'PS', 'PS'])
})

it('smooths a spike into its neighbours and leaves a slope alone', () => {
  const spike = with_(all('NB'), [2, 2, 'PB'])
  const one = blockOf({ row: 2, column: 2 }, { row: 2, column: 2 })
  // (4 x 0.5 + 12 x 0.1) / 16 = 0.2
  expect(smoothed(spike, one, GAINS)).toEqual(with_(all('NB'), [2, 2, 'NS']))

  const slope: Rules = Array.from({ length: 5 }, () => ['NB', 'NS', 'ZO', 'PS', 'PB'])
  expect(smoothed(slope, ALL_RULES, GAINS)).toEqual(slope)
})

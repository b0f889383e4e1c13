/* Goal: the rule grid's edits are what a spreadsheet user expects, and refuse what does not fit. */
import { expect, it } from 'vitest'
import { blockOf, blockText, mapBlock, nudged, pasteText, placeAmong, type Rules } from './table'

const all = (label: Rules[number][number]): Rules =>
  Array.from({ length: 5 }, () => Array(5).fill(label))

it('copies a block as tab-separated lines and pastes it elsewhere', () => {
  const rules = mapBlock(
    all('ZO'),
    blockOf({ row: 0, column: 0 }, { row: 1, column: 1 }),
    () => 'PB',
  )
  const text = blockText(rules, blockOf({ row: 1, column: 1 }, { row: 2, column: 2 }))
  expect(text).toBe('PB\tZO\nZO\tZO')

  const pasted = pasteText(all('NB'), { row: 3, column: 3 }, text)

  expect('rules' in pasted && pasted.rules.slice(3).map((row) => row.slice(3))).toEqual([
    ['PB', 'ZO'],
    ['ZO', 'ZO'],
  ])
})

it('takes numbers and lower case as labels too', () => {
  const pasted = pasteText(all('ZO'), { row: 0, column: 0 }, '1\tpb\r\n')

  expect('rules' in pasted && pasted.rules[0]?.slice(0, 2)).toEqual(['NB', 'PB'])
})

it('refuses a block that does not fit instead of cutting it', () => {
  expect(pasteText(all('ZO'), { row: 4, column: 4 }, 'NB\tNB')).toEqual({ problem: 'too_large' })
})

it('refuses words that are no labels', () => {
  expect(pasteText(all('ZO'), { row: 0, column: 0 }, 'NB\thello')).toEqual({
    problem: 'not_labels',
  })
})

it('nudges no further than the ends', () => {
  expect(nudged('PS', 1)).toBe('PB')
  expect(nudged('PB', 1)).toBe('PB')
  expect(nudged('NB', -1)).toBe('NB')
})

it('places a value among unevenly spaced points', () => {
  expect(placeAmong([0, 10, 30, 40, 50], 20)).toBeCloseTo(1.5)
  expect(placeAmong([0, 10, 30, 40, 50], -3)).toBe(0)
  expect(placeAmong([0, 10, 30, 40, 50], 99)).toBe(4)
})

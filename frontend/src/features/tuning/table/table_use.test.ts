/* Goal: the use of a table is one true sentence, and a number is never rounded
   into nothing or into all of it. */
import type { TableUse } from '$shared/api/types'
import { Locale } from '$shared/i18n/locale.svelte'
import { Units } from '$shared/units/units.svelte'
import { expect, it } from 'vitest'
import { blockSentence, cellShares, hardlyActing, percent, useSentence } from './table_use'

const locale = new Locale()
const units = new Units(locale, 'metric')
const rates = [0, 0.2, 0.4, 0.6, 0.8]
const nothing = () => Array.from({ length: 5 }, () => Array<number>(5).fill(0))
const sum = (numbers: number[]) => numbers.reduce((total, one) => total + one, 0)

/** What the server says of so many seconds in each cell. */
function used(seconds: number[][], change: Partial<TableUse> = {}): TableUse {
  const assisted_s = sum(seconds.flat())
  const point = (at: number, spent: number) => ({
    point: at,
    seconds: spent,
    share: assisted_s ? spent / assisted_s : null,
    motor_wh: null,
  })
  return {
    table: 'first',
    rides: [3, 2],
    rides_without: [],
    rides_by_defaults: [],
    more: false,
    since: null,
    assisted_s,
    motor_excluded_s: assisted_s,
    torque_rate_points_proposed: null,
    columns: rates.map((rate, i) => point(rate, sum(seconds.map((row) => row[i] ?? 0)))),
    rows: seconds.map((row, i) => point(5 * i, sum(row))),
    cells: { seconds, motor_wh: null },
    ...change,
  }
}

const row = (...first: number[]) => [first, ...nothing().slice(1)]
const sentence = (use: TableUse) => useSentence(locale, use, String)
const without = (...codes: TableUse['rides_without'][number]['code'][]) =>
  codes.map((code, id) => ({ id, code, message: '' }))

it('says from which column on the table hardly acts', () => {
  expect(hardlyActing([0.9, 0.06, 0.02, 0.01, 0.01])).toEqual({ from: 3, share: 0.02 })
  expect(hardlyActing([0.5, 0.2, 0.1, 0.1, 0.1])).toBeNull()
  expect(hardlyActing([0.02, 0, 0, 0, 0.98])).toBeNull()

  expect(sentence(used(row(900, 60, 20, 10, 10)))).toBe(
    'Columns right of 0.4 acted 2.0 % of the assisted time in your last 2 rides: changes there ' +
      'are hardly felt.',
  )
})

it('says so where columns never acted, and where all do', () => {
  expect(sentence(used(row(900, 100, 0, 0, 0)))).toContain('right of 0.2 never acted')
  expect(sentence(used(row(200, 200, 200, 200, 200)))).toContain('Every column acted 20 %')
})

it('counts the rides it speaks of and those that say nothing', () => {
  const one = used(row(1, 1, 1, 1, 1), { rides: [3], rides_without: without('missing_channel') })

  expect(sentence(one)).toContain('in your last ride.')
  expect(sentence(one)).toContain('One more ride says nothing')
})

it('says why no ride has data, and what to do', () => {
  const silent = (...codes: Parameters<typeof without>) =>
    sentence(used(nothing(), { rides: [], rides_without: without(...codes) }))

  expect(silent()).toContain('ride with Spindle connected')
  expect(silent('missing_channel', 'missing_channel')).toContain('torque rate or mode is missing')
  expect(silent('missing_channel', 'not_assisted')).toContain('ride in a mode that uses it')
})

it('rounds no share to nothing and none to all of it', () => {
  const parts = [0, 0.0001, 0.006, 0.0994, 0.0996, 0.96, 0.9999, 1]

  const read = parts.map((part) => percent(locale, part))

  expect(read).toEqual(['0', '<0.1', '0.6', '9.9', '10', '96', '99.9', '100'])
})

it('adds up the cells that are chosen', () => {
  const seconds = [[60, 30, 0, 0, 0], [6, 3, 0, 0, 0], ...nothing().slice(2)]
  const motor_wh = seconds.map((cells) => cells.map((spent) => spent / 100))
  const use = used(seconds, { cells: { seconds, motor_wh } })
  const block = (top: number, left: number, bottom: number, right: number) =>
    blockSentence(locale, units, use, { top, left, bottom, right })

  expect(block(0, 0, 1, 0)).toBe('Ridden here: 67 % of the assisted time, 1:06, 0.66\u00a0Wh.')
  expect(block(1, 1, 1, 1)).toContain('3.0\u00a0s, 0.03\u00a0Wh')
  expect(block(0, 2, 4, 4)).toBe('Never reached in your last 2 rides.')
  expect(blockSentence(locale, units, used(seconds), { top: 0, left: 0, bottom: 0, right: 0 }))
    .toContain('motor energy not known')
})

it('has no cell where no ride has data', () => {
  const nowhere = used(nothing(), { rides: [] })
  const corner = { top: 0, left: 0, bottom: 0, right: 0 }

  expect([cellShares(null), cellShares(nowhere)]).toEqual([null, null])
  expect(blockSentence(locale, units, nowhere, corner)).toBe('Ridden here: —')
  expect(cellShares(used(row(3, 1, 0, 0, 0)))?.[0]).toEqual([0.75, 0.25, 0, 0, 0])
})

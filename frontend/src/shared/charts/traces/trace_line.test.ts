/* Goal: a ride's curve keeps every extreme and crosses no gap; its time axis reads as a clock. */
import { expect, it } from 'vitest'
import { binLine, moment, timeTicks } from './trace_line'

const f64 = (...values: number[]) => Float64Array.from(values)

it('touches the least and the greatest value of every bin', () => {
  const { x, y } = binLine(f64(0, 10), f64(9, 19), f64(1, 2), f64(5, 95))

  expect([...x]).toEqual([0, 9, 10, 19])
  expect([...y]).toEqual([1, 5, 2, 95])
})

it('leaves a missing bin missing', () => {
  const { y } = binLine(f64(0, 10), f64(9, 19), f64(1, NaN), f64(5, NaN))

  expect([...y].slice(2).every(Number.isNaN)).toBe(true)
})

it('draws rows as they are when every row is its own bin', () => {
  const rows = f64(1, 2, 3)

  expect(binLine(f64(0, 1, 2), f64(0, 1, 2), rows, rows).y).toBe(rows)
})

it('marks a two-hour ride at round minutes', () => {
  const { text } = timeTicks(0, 7200, 10)

  expect(text).toEqual([
    '0:00',
    '15:00',
    '30:00',
    '45:00',
    '1:00:00',
    '1:15:00',
    '1:30:00',
    '1:45:00',
    '2:00:00',
  ])
})

it('shows tenths only where whole seconds would repeat', () => {
  expect(moment(3661.25, 1)).toBe('1:01:01')
  expect(moment(3661.2, 0.1)).toBe('1:01:01.2')
  expect(moment(3661.97, 0.1)).toBe('1:01:02.0')
})

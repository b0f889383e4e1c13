/* Goal: what a person types or pastes is read as he means it, or not at all. Expected values are
   the numbers as spoken; decimal commas and groups after ISO 80000-1, 7.3. */
import { describe, expect, it } from 'vitest'
import { readNumber, readNumbers } from './read_number'

describe('one number', () => {
  it.each([
    ['2.5', 2.5],
    ['2,5', 2.5],
    [' 172,5 ', 172.5],
    ['1 234,5', 1234.5],
    ['1\u202f234,5', 1234.5],
    ["1'234.5", 1234.5],
    ['1’234.5', 1234.5],
    ['1.234,5', 1234.5],
    ['1,234.5', 1234.5],
    ['1,234,567', 1234567],
    ['1.234.567', 1234567],
    ['1.234', 1.234],
    ['1,234', 1.234],
    ['-3', -3],
    ['−3,5', -3.5],
    ['+3', 3],
    ['.5', 0.5],
    ['5.', 5],
    ['0', 0],
    ['1e-5', 1e-5],
    ['2,5e3', 2500],
    ['１７２．５', 172.5],
  ])('reads %j as %d', (text, value) => {
    expect(readNumber(text)).toBe(value)
  })

  it.each([
    ...['', ' ', '-', '.', 'abc', '12 kg', '1 2', '1,2,3', '1,23,456', '1,234,56', "1 234'567"],
    ...['1.2.3', '2,5.5', '0x10', 'Infinity', '1e', 'e5', '--5', '1-2', '１２個'],
  ])('reads nothing from %j', (text) => {
    expect(readNumber(text)).toBeNaN()
  })

  it('takes its own unit behind the number, and no other', () => {
    expect(readNumber('172,5 mm', 'mm')).toBe(172.5)
    expect(readNumber('172.5mm', '± mm')).toBe(172.5)
    expect(readNumber('10 KG', 'kg')).toBe(10)
    expect(readNumber('17.25 cm', 'mm')).toBeNaN()
  })
})

describe('a list of numbers', () => {
  it.each([
    ['10, 20', [10, 20]],
    ['10; 20', [10, 20]],
    ['10 20', [10, 20]],
    ['10、20；30', [10, 20, 30]],
    ['10，20', [10, 20]],
    ['2,5; 5', [2.5, 5]],
    ['2,5 5', [2.5, 5]],
    ['2,5, 5', [2.5, 5]],
    ['10 kg, 20 kg', [10, 20]],
    ['10kg, 20kg', [10, 20]],
    ['10', [10]],
    ['', []],
  ])('reads %j as %j', (text, values) => {
    expect(readNumbers(text, 'kg')).toEqual(values)
  })

  it.each(['10,20', '10, x', '10 lb, 20 lb'])('has something unread in %j', (text) => {
    expect(readNumbers(text, 'kg').some(Number.isNaN)).toBe(true)
  })
})

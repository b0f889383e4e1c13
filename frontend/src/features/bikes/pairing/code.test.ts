/* Goal: a code is read however it was typed or copied. */
import { expect, it } from 'vitest'
import { codeIn, readCode } from './code'

const TYPED = ['ABCD-EFGH', 'abcd efgh', ' abcdefgh ', 'AB CD – EF GH', 'abcd_efgh']

it.each(TYPED)('reads %j', (typed) => expect(readCode(typed)).toBe('ABCD-EFGH'))

it.each(['', 'ABCD', 'ABCD-EFGHI', 'ABCD-EFG!'])('finds no code in %j', (typed) =>
  expect(readCode(typed)).toBeNull(),
)

it('finds a code in an address', () => {
  expect([codeIn('#ABCD-EFGH'), codeIn('#abcd%20efgh'), codeIn('#%'), codeIn('')]).toEqual([
    'ABCD-EFGH',
    'abcd efgh',
    '%',
    '',
  ])
})

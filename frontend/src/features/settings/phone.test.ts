// Goal: a fingerprint is shown in full, in lines that fit a phone. SHA-256 has 32 bytes.
import { expect, it } from 'vitest'
import { fingerprintLines } from './phone'

it('shows all pairs of a fingerprint, eight in a line', () => {
  const pairs = Array.from({ length: 32 }, (_, n) => n.toString(16).toUpperCase().padStart(2, '0'))

  const lines = fingerprintLines(pairs.join(':'))

  expect(lines).toHaveLength(4)
  expect(lines[0]).toBe('00 01 02 03 04 05 06 07')
  expect(lines.join(' ').split(' ')).toEqual(pairs)
})

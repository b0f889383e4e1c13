/* Goal: a token is taken however a maker sends it, and nothing else is taken for one. */
import { describe, expect, it } from 'vitest'
import { challengeFile, challengeText, tokenIn } from './token'

const TOKEN = '0123456789abcdef'.repeat(9)
const CHALLENGE = {
  uid: 'a1b2',
  nonce: '00112233445566778899',
  level: 'dealer',
  ttl_s: 60,
  expires_us: 61_000_000,
  image: '00ff',
  image_sha512: 'ab'.repeat(64),
}

describe('a token', () => {
  it('is taken with line breaks and spaces of a mail', () => {
    expect(tokenIn(` ${TOKEN.slice(0, 70)}\r\n${TOKEN.slice(70)}\n`)).toBe(TOKEN)
  })
  it('is found in a file that says more', () => {
    expect(tokenIn(`{"token": "${TOKEN}", "unit": "a1b2"}`)).toBe(TOKEN)
  })
  it('is not made of what is too short, too long or twice', () => {
    expect(tokenIn(TOKEN.slice(1))).toBeNull()
    expect(tokenIn(`${TOKEN}0`)).toBeNull()
    expect(tokenIn(`first: ${TOKEN}; second: ${TOKEN}`)).toBeNull()
    expect(tokenIn('')).toBeNull()
  })
})

it('hands the maker everything that is signed, in a file named after the unit', () => {
  expect(JSON.parse(challengeText(CHALLENGE))).toEqual({ challenge: CHALLENGE })
  expect(challengeFile(CHALLENGE)).toBe('challenge-a1b2-00112233.json')
})

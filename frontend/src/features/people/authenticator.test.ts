import { describe, expect, it } from 'vitest'
import { base64url, bytesOf } from './authenticator'

describe('bytes as an authenticator has them', () => {
  it.each([
    [[], ''],
    [[0], 'AA'],
    [[255, 239, 190], '_---'],
    [[251, 255, 254, 1], '-__-AQ'],
  ])('are text without padding: %j', (numbers, text) => {
    const bytes = Uint8Array.from(numbers)

    expect(base64url(bytes.buffer)).toBe(text)
    expect([...bytesOf(text)]).toEqual(numbers)
  })
})

// @vitest-environment happy-dom
// Goal: an event of a ride is described in words that a rider understands, in both languages.
import { describe, expect, it } from 'vitest'
import { Locale } from '$shared/i18n/locale.svelte'
import { eventText } from './ride_events'

const FROM_2020_MS = Date.UTC(2026, 10, 27, 9) - Date.UTC(2020, 0, 1, 0, 1, 30)

describe('a clock that was set in mid-ride', () => {
  const sentence = (value: number, locale = new Locale()) =>
    eventText({ t_s: 60, kind: 'clock_set', value }, locale, String)

  it('is described with its direction and distance', () => {
    expect(sentence(FROM_2020_MS)).toContain('forward by 2,522 d 8:58:30')
    expect(sentence(-3_600_000)).toContain('back by 1:00:00')
  })
})

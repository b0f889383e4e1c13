// @vitest-environment happy-dom
/* Goal: whatever is doubtful of a ride is said with both figures, in every language. */
import { expect, it } from 'vitest'
import { Locale, fill } from '$shared/i18n/locale.svelte'
import { Units } from '$shared/units/units.svelte'
import en from '$messages/en/doubts.json'
import { doubtText, type Doubt } from './doubt_text'
import type { Say } from './words'

const locale = new Locale()
const say: Say = (key, values) => fill(en[key], values)
const text = (doubt: Partial<Doubt> & Pick<Doubt, 'code'>) =>
  doubtText(
    { figure: 0, against: 0, unit: '', channel: null, seconds: null, accepted: false, ...doubt },
    say,
    locale,
    new Units(locale, 'metric'),
  ).replaceAll('\u00a0', ' ')

it('names both figures with their unit', () => {
  expect(text({ code: 'wheel_and_track', figure: 14.5, against: 28.9, unit: 'km' })).toContain(
    '14.50 km by the wheel and 28.90 km by its positions',
  )
  expect(text({ code: 'stated_time', figure: 3600, against: 4800, unit: 's' })).toContain(
    '1:00:00 in its rows, 1:20:00 as its device states',
  )
})

it('says over how long a power is the mean, and whose values are lost', () => {
  expect(
    text({ code: 'power', figure: 612, against: 500, unit: 'W', seconds: 1200 }),
  ).toContain('612 W over 20:00')
  expect(
    text({ code: 'values_left_out', figure: 590, against: 600, channel: 'speed_kmh' }),
  ).toContain('590 of 600 values of Speed')
})

/* Goal: a share of temperature is given in the reader's degrees. */
import { expect, it } from 'vitest'
import { Locale } from '$shared/i18n/locale.svelte'
import { Units } from '$shared/units/units.svelte'
import { dateText, perDegree } from './drift_text'

it('gives a share in kelvins, or in degrees Fahrenheit', () => {
  const locale = new Locale()

  expect(perDegree(new Units(locale, 'metric'), 0.018)).toBe('0.0180\u00a0Nm/K')
  // 0.01 Nm is 0.00738 lbf·ft.
  expect(perDegree(new Units(locale, 'imperial'), 0.018)).toBe('0.0074\u00a0lbf·ft/°F')
})

it('gives a date with its year', () => {
  expect(dateText(new Locale(), '2027-10-25T12:00:00Z')).toBe('25 Oct 2027')
  expect(dateText(new Locale(), null)).toBe('—')
})

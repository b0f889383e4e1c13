/* Goal: with miles go feet, and no value is converted that is not a length or
   a speed of the road. Factors: one foot is 0.3048 m, one mile 1609.344 m, exactly. */
import { expect, it } from 'vitest'
import { Locale } from '../i18n/locale.svelte'
import { Units } from './units.svelte'

const imperial = new Units(new Locale(), 'imperial')

it('shows acceleration in feet where speed is in miles', () => {
  expect(imperial.text(0.3048, 'm/s²')).toBe('1.00\u00a0ft/s²')
  expect(imperial.text(1.609344, 'km/h')).toBe('1.0\u00a0mph')
})

it('shows heights in feet and leaves a wheel in metres', () => {
  expect(imperial.text(304.8, 'm of altitude')).toBe('1,000\u00a0ft')
  expect(imperial.label('m')).toBe('m')
})

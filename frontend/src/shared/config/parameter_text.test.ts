/* Goal: a value is exact in the unit's own measure and readable in another. */
import { Locale } from '../i18n/locale.svelte'
import { Units } from '../units/units.svelte'
import { expect, it } from 'vitest'
import type { Parameter } from '../api/types'
import { valueText } from './parameter_text'
import { shownTyped } from '../units/typed'

const metric = new Units(new Locale(), 'metric')
const imperial = new Units(new Locale(), 'imperial')

it('shows what is stored as it is stored', () => {
  expect(shownTyped(0.0072345, 'Nm/count', metric)).toBe('0.0072345')
  expect(shownTyped(24.94494, 'km/h', metric)).toBe('24.9449')
})

it('shows a converted value to four digits, so that it fits its field', () => {
  expect([5, 10, 25].map((kmh) => shownTyped(kmh, 'km/h', imperial))).toEqual([
    '3.107',
    '6.214',
    '15.53',
  ])
})

it('shows nothing for what is missing', () => {
  expect(shownTyped(NaN, 'km/h', imperial)).toBe('')
})

it('shows a moment as a moment and a certificate as the paper has it', () => {
  const locale = new Locale()
  const shown = (name: string, value: number | number[]) =>
    valueText(locale, metric, { name, unit: 's' } as Parameter, value)

  expect(shown('calibrated_at_utc_s', 1795650000)).toBe(locale.instant('2026-11-25T23:40:00.000Z'))
  expect(shown('calibrated_at_utc_s', 0)).toBe('—')
  expect(shown('calibration_certificate', [1, 2, 171])).toBe('0102ab')
  expect(shown('calibration_certificate', [0, 0, 0])).toBe('—')
})

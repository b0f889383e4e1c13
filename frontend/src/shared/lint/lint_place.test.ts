/* Goal: a finding names its place in the table, not which index of which array. */
import { Locale, type Language } from '$shared/i18n/locale.svelte'
import { Units, type System } from '$shared/units/units.svelte'
import { expect, it } from 'vitest'
import { lintPlace } from './lint_place'

const chinese = new Locale()
await chinese.speak('zh')

function place(where: string, language: Language = 'en', system: System = 'metric') {
  const locale = language === 'zh' ? chinese : new Locale()
  return lintPlace(where, locale, new Units(locale, system))
}

it('counts rows and columns from one, and modes by their slot', () => {
  expect(place('rules[2][0]')).toBe('row 3, column 1')
  expect(place('rules[4]')).toBe('row 5')
  expect(place('rules[][1]')).toBe('column 2')
  expect(place('modes[3]')).toBe('mode 3')
  expect(place('modes[3].ratio')).toBe('mode 3')
})

it("speaks the reader's language and units", () => {
  expect(place('9.4 km/h, torque rate 0.87', 'zh')).toBe('9.4\u00a0km/h，扭矩变化率 0.87')
  expect(place('16.1 km/h, torque rate 0.87', 'en', 'imperial')).toContain('10.0\u00a0mph')
  expect(place('torque rate 0', 'zh')).toBe('扭矩变化率 0')
})

it('calls a parameter by its name', () => {
  expect(place('assist_cutoff_kmh')).toBe('Cut-off speed')
})

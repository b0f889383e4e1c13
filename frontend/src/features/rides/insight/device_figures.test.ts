// @vitest-environment happy-dom
import { expect, test } from 'vitest'
import { clock, type Locale } from '$shared/i18n/locale.svelte'
import { nameOf, valueOf } from './device_figures'
import en from '$messages/en/insight.json'
import type { Key } from './words'

const number = (value: number, digits: number) => value.toFixed(digits)
const locale = { number, duration: clock } as unknown as Locale
const say = (key: Key) => en[key]

test('what the device stated has a name in words and a unit of the pages', () => {
  const shown = [
    { name: 'lev_battery_consumption', value: 34.5, unit: '%' },
    { name: 'total_work', value: 1371062, unit: 'J' },
    { name: 'avg_speed', value: 5, unit: 'm/s' },
    { name: 'avg_vam', value: 0.25, unit: 'm/s' },
    { name: 'total_distance', value: 78940, unit: 'm' },
    { name: 'total_timer_time', value: 3661, unit: 's' },
  ].map((figure) => `${nameOf(figure, say)}: ${valueOf(figure, locale)}`)

  expect(shown).toEqual([
    'Battery used: 34.50 %',
    'Work: 1371.06 kJ',
    'Speed, mean: 18 km/h',
    'avg_vam: 0.25 m/s',
    'Distance: 78.94 km',
    'Timer: 1:01:01',
  ])
})

test('an unknown figure keeps its name and has no unit', () => {
  const figure = { name: 'unknown_177', value: 400, unit: '' }

  expect(nameOf(figure, say)).toBe('unknown_177')
  expect(valueOf(figure, locale)).toBe('400')
})

/* Goal: an impossible value is named, element by element, before anybody is asked. */
import { expect, it } from 'vitest'
import { faultsOf } from './limits'
import type { Parameter } from './types'

const parameter = (name: string, type = 'f32', min: number | null = 0, max: number | null = 0.5) =>
  ({
    id: 1,
    name,
    group: 'fuzzy',
    type,
    shape: [5],
    unit: '',
    min,
    max,
    default: 0,
    access: 'DEALER',
    value: null,
    choices: null,
    description: '',
  }) as Parameter

it('names the element that is out of range, with the bound', () => {
  const faults = faultsOf(parameter('fuzzy_gain_points'), [0.1, 0.2, 0.3, 0.4, 0.9])

  expect(faults).toEqual([
    { name: 'fuzzy_gain_points', path: [4], fault: { code: 'above_max', bound: 0.5 } },
  ])
})

it('finds points that do not increase', () => {
  const faults = faultsOf(parameter('fuzzy_gain_points'), [0.1, 0.3, 0.3, 0.4, 0.5])

  expect(faults.map((f) => [f.path, f.fault.code])).toEqual([[[2], 'not_increasing']])
})

it('finds what is not a number', () => {
  expect(faultsOf(parameter('assist_cutoff_kmh'), NaN)[0]?.fault.code).toBe('not_a_number')
})

it('counts bytes of a text, not letters', () => {
  const name = parameter('mode_names', 'text', null, null)

  expect(faultsOf(name, ['运动运动运'])).toEqual([])
  expect(faultsOf(name, ['运动运动运动'])[0]?.fault.code).toBe('not_text')
})

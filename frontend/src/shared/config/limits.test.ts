/* Goal: an impossible value is named, element by element, before a request is sent. */
import { expect, it } from 'vitest'
import type { Parameter } from '../api/types'
import { faultsOf } from './limits'

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
    access: 'dealer',
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

it('takes points a least step apart, however they round, and none that are nearer', () => {
  for (let tenth = 0; tenth <= 446; tenth++) {
    const points = [0, 1, 2, 3, 4].map((k) => (tenth + k) / 10)
    expect(faultsOf(parameter('fuzzy_speed_points_kmh', 'f32', 0, 45), points)).toEqual([])
  }
  const near = faultsOf(parameter('fuzzy_speed_points_kmh', 'f32', 0, 45), [0, 10, 10.09, 20, 30])
  const denormal = [0, 1.4e-45, 2.8e-45, 4.2e-45, 5.6e-45]

  expect(near.map((f) => [f.path, f.fault])).toEqual([
    [[2], { code: 'not_increasing', bound: 0.1 }],
  ])
  expect(faultsOf(parameter('fuzzy_gain_points'), denormal)).toHaveLength(4)
})

it('finds what is not a number', () => {
  expect(faultsOf(parameter('assist_cutoff_kmh'), NaN)[0]?.fault.code).toBe('not_a_number')
})

it('counts bytes of a text, not letters', () => {
  const name = parameter('mode_names', 'text', null, null)

  expect(faultsOf(name, ['运动运动运'])).toEqual([])
  expect(faultsOf(name, ['运动运动运动'])[0]?.fault.code).toBe('not_text')
})

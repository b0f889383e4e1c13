/* Goal: going back to an older tuning never takes back what was measured on the bike since. */
import { expect, it } from 'vitest'
import type { Comparison, Parameter } from '$shared/api/types'
import { restoredParts } from './restored_parts'

const parameter = (name: string, group: string, of_the_unit = false, access = 'dealer') =>
  ({ name, group, of_the_unit, access }) as Parameter

const PARAMETERS = [
  parameter('sensor_gain_nm_per_count', 'sensor', true),
  parameter('torque_filter_s', 'sensor'),
  parameter('fuzzy_rules', 'fuzzy'),
  parameter('gear_ratio', 'drivetrain', true, 'factory'),
  parameter('wheel_circumference_m', 'drivetrain', true),
  parameter('calibration_certificate', 'calibration', true),
]

it('separates tuning from what was measured, and a calibration from its wheel', () => {
  const all = PARAMETERS.map(({ name }) => ({ name, old: 1, new: 2 }))

  expect(restoredParts(all as Comparison['parameters'], PARAMETERS)).toEqual([
    {
      key: 'unit/calibration',
      group: 'calibration',
      of_the_unit: true,
      names: ['sensor_gain_nm_per_count', 'calibration_certificate'],
    },
    { key: 'tuning/sensor', group: 'sensor', of_the_unit: false, names: ['torque_filter_s'] },
    { key: 'tuning/fuzzy', group: 'fuzzy', of_the_unit: false, names: ['fuzzy_rules'] },
    {
      key: 'unit/drivetrain',
      group: 'drivetrain',
      of_the_unit: true,
      names: ['wheel_circumference_m'],
    },
  ])
})

it('has no part of what does not differ', () => {
  expect(restoredParts([], PARAMETERS)).toEqual([])
})

/* Goal: every parameter of a unit has its place on some page, also of a unit this Spindle has never
   seen. */
import type { Device, Parameter } from '../api/types'
import { expect, it } from 'vitest'
import { groupsOf } from './groups'

const rows = (...groups: string[]) => groups.map((group) => ({ group })) as unknown as Parameter[]
const unit = (...capabilities: string[]) => ({ capabilities }) as unknown as Device

it('leaves tables and sensor to their own places where the unit has them', () => {
  const device = unit('read_config', 'fuzzy_table', 'stream', 'rider_torque')
  const parameters = rows('sensor', 'fuzzy', 'drivetrain', 'second_table', 'limits', 'assist')

  expect(groupsOf(parameters, device)).toEqual(['assist', 'limits', 'drivetrain'])
})

it('shows all groups of a unit that has neither, new ones last', () => {
  const parameters = rows('display', 'sensor', 'limits', 'display')

  expect(groupsOf(parameters, unit('read_config'))).toEqual(['limits', 'display', 'sensor'])
})

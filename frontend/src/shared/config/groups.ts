// Which groups of parameters are plain forms next to tables and modes, in which order.
import type { Device, Parameter } from '../api/types'
import { can, hasPage } from '../device/capabilities'

const FIRST = ['assist', 'limits', 'market', 'drivetrain']
const OF_TABLES = ['fuzzy', 'second_table']

/** The groups of a unit but those that its tables and its sensor's page show; groups that this
    Spindle does not know come last, in the unit's own order. */
export function groupsOf(parameters: readonly Parameter[], device: Device | null): string[] {
  const elsewhere = [
    ...(can(device, 'fuzzy_table') ? OF_TABLES : []),
    ...(hasPage(device, 'sensor') ? ['sensor', 'calibration'] : []),
  ]
  const groups = [...new Set(parameters.map((parameter) => parameter.group))]
  const here = groups.filter((group) => !elsewhere.includes(group))
  const first = FIRST.filter((group) => here.includes(group))
  return [...first, ...here.filter((group) => !first.includes(group))]
}

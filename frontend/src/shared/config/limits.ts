// What is wrong with a value before a request is sent: the unit's own bounds, one message a field.
import { PARAMETERS, type ParameterRow } from '$generated/registry'
import type { Parameter, ParameterValue } from '../api/types'

export type Fault =
  | { code: 'not_a_number' | 'not_text' }
  | { code: 'below_min' | 'above_max' | 'not_increasing'; bound: number }

/** What a value is made of; null where it may be none. */
export type Element = number | string | null

export interface FieldFault {
  name: string
  path: number[]
  fault: Fault
}

const rows: Readonly<Record<string, ParameterRow>> = PARAMETERS

/** Every fault of a parameter's value, with the index of the element at fault. */
export function faultsOf(parameter: Parameter, value: ParameterValue): FieldFault[] {
  const faults: FieldFault[] = []
  const at = (path: number[], fault: Fault) => faults.push({ name: parameter.name, path, fault })
  walk(value, [], (element, path) => {
    const fault = elementFault(parameter, element)
    if (fault) at(path, fault)
  })
  const step = rows[parameter.name]?.least_step ?? 0
  if (step > 0 && Array.isArray(value) && faults.length === 0) {
    const points = value as number[]
    points.forEach((point, i) => {
      const before = points[i - 1]
      if (before !== undefined && isTooNear(before, point, step))
        at([i], { code: 'not_increasing', bound: step })
    })
  }
  return faults
}

/** As the unit computes it, in float32 throughout: a hundredth is for the decimals' rounding. */
function isTooNear(before: number, point: number, step: number): boolean {
  const f = Math.fround
  return f(f(point) - f(before)) < f(f(0.99) * f(step))
}

function elementFault(parameter: Parameter, element: Element): Fault | null {
  if (element === null) return parameter.may_be_none ? null : { code: 'not_a_number' }
  if (parameter.type === 'text') {
    const bytes = new TextEncoder().encode(String(element)).length
    return bytes > (rows[parameter.name]?.length ?? Infinity) ? { code: 'not_text' } : null
  }
  if (typeof element === 'string') return null
  if (!Number.isFinite(element)) return { code: 'not_a_number' }
  const { min, max } = parameter
  if (min != null && element < min) return { code: 'below_min', bound: min }
  if (max != null && element > max) return { code: 'above_max', bound: max }
  return null
}

/** Calls `visit` for every element of a value with its index path. */
export function walk(
  value: ParameterValue,
  path: number[],
  visit: (element: Element, path: number[]) => void,
): void {
  if (Array.isArray(value)) value.forEach((v, i) => walk(v as ParameterValue, [...path, i], visit))
  else visit(value, path)
}

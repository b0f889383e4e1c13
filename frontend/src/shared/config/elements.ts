// The elements of a parameter's value: a number or word, or rows of them.
import type { ParameterValue } from '../api/types'
import type { Element } from './limits'

export function same(a: ParameterValue | undefined, b: ParameterValue | undefined): boolean {
  return JSON.stringify(a) === JSON.stringify(b)
}

/** How many elements differ. */
export function differing(a: ParameterValue, b: ParameterValue): number {
  if (!Array.isArray(a) || !Array.isArray(b)) return same(a, b) ? 0 : 1
  const others = b as ParameterValue[]
  return (a as ParameterValue[]).reduce<number>(
    (sum, element, i) => sum + differing(element, others[i] as ParameterValue),
    0,
  )
}

/** An edit on what the unit has now: its own elements where it changed what was, and what is now
    everywhere else. Of another shape it stays as it is. */
export function rebased(
  edit: ParameterValue,
  was: ParameterValue | undefined,
  now: ParameterValue | undefined,
): ParameterValue {
  if (was === undefined || now === undefined) return edit
  const lists = [edit, was, now].filter(Array.isArray) as ParameterValue[][]
  const [mine, old, theirs] = lists
  if (mine && old && theirs && mine.length === old.length && mine.length === theirs.length) {
    return mine.map((element, i) => rebased(element, old[i], theirs[i])) as ParameterValue
  }
  return lists.length === 0 && same(edit, was) ? now : edit
}

export function elementAt(value: ParameterValue | undefined, path: number[]): Element | undefined {
  let at: unknown = value
  for (const index of path) at = (at as unknown[] | undefined)?.[index]
  return at as Element | undefined
}

/** The value with another element at a place. */
export function withElement(
  value: ParameterValue,
  [index, ...rest]: number[],
  element: ParameterValue,
): ParameterValue {
  if (index === undefined) return element
  const rows = value as ParameterValue[]
  const inner = withElement(rows[index] as ParameterValue, rest, element)
  return rows.with(index, inner) as ParameterValue
}

// Numbers as a field holds them: without groups, so that they can be typed over.
import type { Units } from './units.svelte'

/** A number as it is typed: enough digits to be exact in float32, none too many. */
export function typed(value: number): string {
  return Number.isFinite(value) ? String(Number(value.toPrecision(6))) : ''
}

/** A value where it can be typed: unrounded in its own unit, to four digits in another. */
export function shownTyped(value: number, unit: string, units: Units): string {
  const shown = units.show(value, unit)
  return typed(shown === value ? shown : Number(shown.toPrecision(4)))
}

// Figures of the whole ride as its device stated them: name and value, in the units of the pages.
import type { Ride } from '$shared/api/types'
import type { Locale } from '$shared/i18n/locale.svelte'
import en from '$messages/en/insight.json'
import type { Key, Say } from './words'

export type Stated = Ride['statements'][number]['figures'][number]

/** Unit of the file -> ours, and how many of ours it is. */
const ours: Record<string, [unit: string, factor: number]> = {
  'm/s': ['km/h', 3.6],
  J: ['kJ', 0.001],
  degC: ['°C', 1],
}
const DIGITS = 2

/** A figure's name: in words where they are known, else as the file has it. */
export function nameOf(stated: Stated, say: Say): string {
  const key = `stated_${stated.name}`
  return key in en ? say(key as Key) : stated.name
}

export function valueOf(stated: Stated, locale: Locale): string {
  if (stated.unit === 's') return locale.duration(stated.value)
  const [unit, factor] =
    stated.unit === 'm' && Math.abs(stated.value) >= 1000
      ? (['km', 0.001] as const)
      : (ours[stated.unit] ?? [stated.unit, 1])
  // A climb's speed is in m/s for everybody.
  const climbs = stated.name.includes('vertical') || stated.name === 'avg_vam'
  const shown = climbs ? stated.value : stated.value * factor
  const digits = Number.isInteger(shown) ? 0 : DIGITS
  return `${locale.number(shown, digits)} ${climbs ? stated.unit : unit}`.trim()
}

// Figures of the whole ride as its device reports them: name and value, in the units of the pages.
import type { Ride } from '$shared/api/types'
import type { Locale } from '$shared/i18n/locale.svelte'
import en from '$messages/en/insight.json'
import type { Key, Say } from './words'

export type StatedFigure = Ride['statements'][number]['figures'][number]

/** Unit of the file -> ours, and how many of ours it is. */
const ours: Record<string, [unit: string, factor: number]> = {
  'm/s': ['km/h', 3.6],
  J: ['kJ', 0.001],
  degC: ['°C', 1],
}
const DIGITS = 2

/** A figure's name: in words where they are known, else as the file has it. */
export function nameOf(figure: StatedFigure, say: Say): string {
  const key = `device_${figure.name}`
  return key in en ? say(key as Key) : figure.name
}

export function valueOf(figure: StatedFigure, locale: Locale): string {
  if (figure.unit === 's') return locale.duration(figure.value)
  const [unit, factor] =
    figure.unit === 'm' && Math.abs(figure.value) >= 1000
      ? (['km', 0.001] as const)
      : (ours[figure.unit] ?? [figure.unit, 1])
  // A climb's speed is in m/s for everybody.
  const climbs = figure.name.includes('vertical') || figure.name === 'avg_vam'
  const shown = climbs ? figure.value : figure.value * factor
  const digits = Number.isInteger(shown) ? 0 : DIGITS
  return `${locale.number(shown, digits)} ${climbs ? figure.unit : unit}`.trim()
}

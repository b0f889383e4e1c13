// Stored values are SI with the unit in their name; conversion happens here, at the view's edge.
import type { Locale } from '../i18n/locale.svelte'

export type System = 'metric' | 'imperial'

interface Shown {
  unit: string
  factor: number
  offset: number
  digits: number
}

const plain = (unit: string, digits: number): Shown => ({ unit, factor: 1, offset: 0, digits })

const metric: Record<string, Shown> = {
  'km/h': plain('km/h', 1),
  Nm: plain('Nm', 1),
  degC: plain('°C', 1),
  'degC apart': plain('°C', 1), // a difference has no zero of its own
  km: plain('km', 2),
  rpm: plain('rpm', 0),
  W: plain('W', 0),
  Wh: plain('Wh', 1),
  'Wh/km': plain('Wh/km', 2),
  V: plain('V', 1),
  A: plain('A', 2),
  '%': plain('%', 0),
  counts: plain('counts', 0),
  s: plain('s', 1),
  ms: plain('ms', 0),
  deg: plain('°', 1),
  bpm: plain('bpm', 0),
  m: plain('m', 0),
  'm of altitude': plain('m', 0), // heights are read in feet where wheels are not
  'm/s²': plain('m/s²', 2),
  '': plain('', 2),
}

const imperial: Record<string, Shown> = {
  ...metric,
  'km/h': { unit: 'mph', factor: 0.621371, offset: 0, digits: 1 },
  Nm: { unit: 'lbf·ft', factor: 0.737562, offset: 0, digits: 1 },
  'Nm/s': { unit: 'lbf·ft/s', factor: 0.737562, offset: 0, digits: 1 },
  'Nm/count': { unit: 'lbf·ft/count', factor: 0.737562, offset: 0, digits: 5 },
  degC: { unit: '°F', factor: 1.8, offset: 32, digits: 0 },
  'degC apart': { unit: '°F', factor: 1.8, offset: 0, digits: 1 },
  'm/s²': { unit: 'ft/s²', factor: 3.28084, offset: 0, digits: 2 },
  'm of altitude': { unit: 'ft', factor: 3.28084, offset: 0, digits: 0 },
  km: { unit: 'mi', factor: 0.621371, offset: 0, digits: 2 },
  'Wh/km': { unit: 'Wh/mi', factor: 1 / 0.621371, offset: 0, digits: 2 },
}

export class Units {
  system = $state<System>('metric')

  constructor(
    private readonly locale: Locale,
    system: System,
  ) {
    this.system = system
  }

  private shown(unit: string): Shown {
    return (this.system === 'imperial' ? imperial : metric)[unit] ?? plain(unit, 3)
  }

  /** The unit's label on screen, such as "mph" for km/h in imperial. */
  label(unit: string): string {
    const label = this.shown(unit).unit
    return this.locale.lookup(`quantity.${label}`, label)
  }

  /** SI to what is shown. */
  show(value: number, unit: string): number {
    const { factor, offset } = this.shown(unit)
    return value * factor + offset
  }

  /** What was typed back to SI. */
  store(value: number, unit: string): number {
    const { factor, offset } = this.shown(unit)
    return (value - offset) / factor
  }

  /** The number alone, rounded for the unit; "—" for a missing one. */
  number(value: number | null | undefined, unit: string, digits?: number): string {
    if (value == null || !Number.isFinite(value)) return '—'
    return this.locale.number(this.show(value, unit), digits ?? this.shown(unit).digits)
  }

  /** The number with its unit. */
  text(value: number | null | undefined, unit: string, digits?: number): string {
    const number = this.number(value, unit, digits)
    const label = this.label(unit)
    return number === '—' || label === '' ? number : `${number}\u00a0${label}`
  }
}

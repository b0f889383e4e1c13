// The unit that a parameter's name ends in: a closed visit has no device that could say it.
const UNITS: Record<string, string> = {
  nm: 'Nm',
  rpm: 'rpm',
  kmh: 'km/h',
  v: 'V',
  a: 'A',
  s: 's',
  ms: 'ms',
  degc: 'degC',
  m: 'm',
  pct: '%',
}

/** As `valueText` takes a parameter. */
export function namedWithUnit(name: string): { name: string; unit: string } {
  const ending = /_([a-z]+)(?:_(?:min|max))?$/.exec(name)?.[1] ?? ''
  return { name, unit: UNITS[ending] ?? '' }
}

// What two rides have to be drawn: channels in the order of interest, and bins as a series.
import type { Series, SeriesChannel } from '$shared/api/series'
import type { ComparedChannel, ComparedSeries } from '$shared/api/types'
import type { TraceLine, TraceRow } from '$shared/charts/traces/trace_line'

/** B less A. The same in every language. */
export const APART = 'B − A'

const TOKENS: Record<string, string> = {
  speed_kmh: 'speed',
  rider_torque_nm: 'rider',
  rider_power_w: 'rider',
  motor_torque_crank_nm: 'motor',
  motor_torque_demanded_crank_nm: 'motor',
  motor_torque_nm: 'motor',
  motor_torque_demanded_nm: 'motor',
  motor_power_w: 'motor',
  battery_power_w: 'battery',
  fuzzy_gain: 'gain',
  cadence_rpm: 'cadence',
}
const ORDER = [...Object.keys(TOKENS), 'heart_rate_bpm', 'altitude_m']
// The first that both have of each.
const USUAL = [
  ['speed_kmh'],
  ['rider_torque_nm', 'rider_power_w'],
  ['motor_torque_crank_nm', 'motor_torque_demanded_crank_nm', 'motor_torque_nm'],
]

const both = ({ a, b }: ComparedChannel) => a && b
function place({ name }: ComparedChannel): number {
  const matches = ORDER.indexOf(name)
  return matches < 0 ? ORDER.length : matches
}

/** Those that both have first, each part in the order of interest. */
export function inOrder(channels: readonly ComparedChannel[]): ComparedChannel[] {
  return channels.toSorted(
    (one, other) => Number(both(other)) - Number(both(one)) || place(one) - place(other),
  )
}

/** What is shown at first: names. */
export function usualOf(channels: readonly ComparedChannel[]): string[] {
  const common = inOrder(channels).filter(both).map(({ name }) => name)
  const matches = USUAL.flatMap((names) => names.find((name) => common.includes(name)) ?? [])
  return matches.length > 0 ? matches : common.slice(0, 1)
}

/** Heights are read in feet where ways are not. */
export function unitOf({ name, unit }: { name: string; unit: string }): string {
  return name === 'altitude_m' ? 'm of altitude' : unit
}

/** The unit of a difference: degrees apart have no zero of their own. */
export function apartUnit(unit: string): string {
  return unit === 'degC' ? 'degC apart' : unit
}

/** A row of both for each channel, and one of their difference where both have it. */
export function rowsOf(
  channels: readonly ComparedChannel[],
  titles: (name: string) => string,
): TraceRow[] {
  return channels.flatMap((channel) => {
    const { name, a, b } = channel
    const unit = unitOf(channel)
    const token = TOKENS[name] ?? 'battery'
    const lines: TraceLine[] = []
    if (a) lines.push({ channel: `a ${name}`, token: 'line-strong', name: 'A', style: 'broad' })
    if (b) lines.push({ channel: `b ${name}`, token, name: 'B' })
    const row = { key: titles(name), unit, lines }
    if (!both(channel)) return [row]
    const apart = { channel: `apart ${name}`, token: 'accent', name: APART }
    return [row, { key: `${titles(name)}: ${APART}`, unit: apartUnit(unit), lines: [apart] }]
  })
}

/** Bins as a series whose moments are places of the common axis. */
export function seriesOf(comparison: ComparedSeries): Series {
  const edges = Float64Array.from(comparison.x)
  const numbers = (values: readonly (number | null)[]) =>
    Float64Array.from(values, (n) => n ?? NaN)
  const channels = comparison.channels.flatMap(({ name, unit, a, b, difference }) => {
    const matches: SeriesChannel[] = []
    for (const [side, bins] of [['a', a], ['b', b]] as const) {
      if (bins) {
        const [min, max] = [numbers(bins.min), numbers(bins.max)]
        matches.push({ name: `${side} ${name}`, unit, min, max })
      }
    }
    if (difference) {
      // Two arrays: it is drawn from edge to edge of its bin, like the others.
      const [min, max] = [numbers(difference), numbers(difference)]
      matches.push({ name: `apart ${name}`, unit, min, max })
    }
    return matches
  })
  const last = edges.length - 1
  return {
    from_s: edges[0] ?? 0,
    to_s: edges[last] ?? 0,
    rows: last,
    kind: 'minmax',
    axis: comparison.by,
    t_first_s: edges.slice(0, last),
    t_last_s: edges.slice(1),
    channels,
  }
}

/** The bin that a place lies in; -1 outside. */
export function binAt({ t_first_s, t_last_s }: Series, x: number): number {
  const [low, high] = [t_first_s[0], t_last_s[t_last_s.length - 1]]
  if (low === undefined || high === undefined || x < low || x > high) return -1
  return Math.min(t_first_s.length - 1, Math.floor(((x - low) / (high - low)) * t_first_s.length))
}

/** `1:02:03`, `2:03` or `3` as seconds; null for what is none. */
export function secondsOf(text: string): number | null {
  const parts = text.trim().split(':')
  if (parts.length > 3 || parts.some((part) => !/^\d+(\.\d+)?$/.test(part))) return null
  return parts.reduce((sum, part) => 60 * sum + Number(part), 0)
}

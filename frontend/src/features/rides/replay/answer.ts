// A replay as the page shows it: its curves, its figures, and why one is missing.
import { seriesOf, type Series } from '$shared/api/series'
import type { Replay } from '$shared/api/types'
import type { TraceLine, TraceRow } from '$shared/charts/traces/trace_line'

const TORQUE = 'motor_torque_nm'
const DEMANDED = 'motor_torque_demanded_nm'
const GAIN = 'fuzzy_gain'
const REPLAYED = 'replayed_'

/** Whether the record has only the demanded motor torque. */
const isDemandOnly = (replay: Replay) => replay.motor_torque_meaning === 'demanded'

/** The motor torque that is compared: the delivered one, or the demanded one where only that is
    recorded. */
export const comparedTorque = (replay: Replay) => (isDemandOnly(replay) ? DEMANDED : TORQUE)

/** The curves that are drawn, recorded and replayed; a demanded torque is called so. */
export function drawnSeries(replay: Replay): Series {
  const series = seriesOf(replay.series)
  const has = (name: string) => series.channels.some((channel) => channel.name === name)
  // Earlier firmware has one motor torque, the demanded one.
  const is_demand = (name: string) => name === TORQUE && isDemandOnly(replay) && !has(DEMANDED)
  const torque = comparedTorque(replay)
  const shown = [torque, REPLAYED + torque, GAIN, REPLAYED + GAIN]
  const channels = series.channels
    .map((channel) => ({ ...channel, name: is_demand(channel.name) ? DEMANDED : channel.name }))
    .filter(({ name }) => shown.includes(name))
  return { ...series, channels }
}

/** Rows of the chart: as ridden broad and quiet, replayed over it. A curve that the series lacks is
    not named either. */
export function drawnRows(replay: Replay, series: Series): TraceRow[] {
  const lines = (channel: string, token: string) =>
    (
      [
        { channel, token: 'line-strong', name: 'as_ridden', style: 'broad' },
        { channel: REPLAYED + channel, token, name: 'open_loop', style: 'dashed' },
      ] satisfies TraceLine[]
    ).filter((line) => largest(series, line.channel) !== null)
  const key = isDemandOnly(replay) ? 'torque_demanded' : 'torque_delivered'
  return [
    { key, unit: 'Nm', lines: lines(comparedTorque(replay), 'motor') },
    { key: 'gain', unit: '', lines: lines(GAIN, 'gain') },
  ].filter((row) => row.lines.length > 0)
}

/** The largest value of a channel: the bins of a series retain every extreme. */
export function largest(series: Series, name: string): number | null {
  const channel = series.channels.find((c) => c.name === name)
  const valid = channel?.max.filter((value) => !Number.isNaN(value))
  return valid?.length ? valid.reduce((a, b) => Math.max(a, b)) : null
}

/** Why the work as ridden is not known; null where it is. */
export function whyNoWork(replay: Replay): 'demanded' | 'torque' | 'speed' | null {
  if (replay.motor_work_wh.recorded !== null) return null
  if (isDemandOnly(replay)) return 'demanded'
  return replay.motor_torque_meaning === null ? 'torque' : 'speed'
}

/** A figure as ridden and in each loop that was run. */
export interface FigureRow {
  key:
    | 'wh_per_km'
    | 'motor_work_wh'
    | 'torque_nm'
    | 'demanded_nm'
    | 'motor_power_w_mean'
    | 'ripple_nm_per_s'
  unit: string
  digits: number
  recorded: number | null
  replayed: number | null
}

/** The figures of a replay, the one to compare by first. */
export function figureRows(replay: Replay, series: Series): FigureRow[] {
  const torque = comparedTorque(replay)
  const most = { recorded: largest(series, torque), replayed: largest(series, REPLAYED + torque) }
  const row = (
    key: FigureRow['key'],
    unit: string,
    figure: Pick<FigureRow, 'recorded' | 'replayed'> | null,
    digits = 2,
  ): FigureRow => {
    const { recorded, replayed } = figure ?? { recorded: null, replayed: null }
    return { key, unit, digits, recorded, replayed }
  }
  return [
    row('wh_per_km', 'Wh/km', replay.wh_per_km),
    row('motor_work_wh', 'Wh', replay.motor_work_wh),
    row(isDemandOnly(replay) ? 'demanded_nm' : 'torque_nm', 'Nm', most),
    row('motor_power_w_mean', 'W', replay.motor_power_w_mean, 0),
    row('ripple_nm_per_s', 'Nm/s', replay.ripple_nm_per_s),
  ]
}

/** A limit that reduced the motor's torque, as shares of the time, 0 to 1. */
export interface LimitRow {
  name: string
  recorded: number | null
  replayed: number
}

/** The limits at work as ridden or replayed, the longest first. */
export function limitRows(replay: Replay): LimitRow[] {
  const { limit_shares, limit_shares_recorded } = replay
  return Object.entries(limit_shares)
    .map(([name, replayed]) => ({
      name,
      recorded: limit_shares_recorded?.[name] ?? null,
      replayed,
    }))
    .filter(({ recorded, replayed }) => replayed > 0 || (recorded ?? 0) > 0)
    .sort((a, b) => b.replayed - a.replayed)
}

/** The difference of two figures as they are shown, so that a reader who subtracts finds the same;
    null where one is missing. */
export function shownDifference(
  recorded: number | null,
  replayed: number | null,
  digits: number,
): number | null {
  if (recorded === null || replayed === null) return null
  const shown = (value: number) => Number(value.toFixed(digits))
  return Number((shown(replayed) - shown(recorded)).toFixed(digits))
}

/** Which of the words for a difference fits it. */
export function direction(difference: number): 'more' | 'less' | 'same' {
  return difference > 0 ? 'more' : difference < 0 ? 'less' : 'same'
}

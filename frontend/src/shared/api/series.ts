// Traces of a ride as the server sends them: least and greatest count per bin ("SPV1", described
// in backend/rides/traces/trace.py).
import type { components } from '$generated/api'

export interface SeriesChannel {
  name: string
  unit: string
  /** Physical values; NaN where there is no sample. The same array twice when bins are rows. */
  min: Float64Array
  max: Float64Array
}

export interface Series {
  from_s: number
  to_s: number
  /** Rows of the ride within the bins. */
  rows: number
  kind: 'rows' | 'minmax'
  axis: 'time' | 'moving' | 'distance'
  t_first_s: Float64Array
  t_last_s: Float64Array
  /** As the times, in seconds in motion or metres; undefined for the axis of time. */
  x_first?: Float64Array
  x_last?: Float64Array
  channels: SeriesChannel[]
}

interface Header {
  from_s: number
  to_s: number
  rows: number
  bins: number
  kind: 'rows' | 'minmax'
  axis: Series['axis']
  x_first?: { offset: number }
  x_last?: { offset: number }
  t_first_s: { offset: number }
  t_last_s: { offset: number }
  channels: {
    name: string
    unit: string
    scale: number
    dtype: 'int16' | 'int32'
    missing: number
    min_offset: number
    max_offset: number
  }[]
}

/** Reads a series; throws an Error when the bytes are something else. */
export function readSeries(bytes: ArrayBuffer): Series {
  const view = new DataView(bytes)
  const magic = new TextDecoder().decode(new Uint8Array(bytes, 0, Math.min(4, bytes.byteLength)))
  if (magic !== 'SPV1') throw new Error('These bytes are not a series of a ride.')
  const length = view.getUint32(4, true)
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 8, length))) as Header
  const start = 8 + length
  const { bins } = header
  const times = (offset: number) => new Float64Array(bytes, start + offset, bins)
  return {
    from_s: header.from_s,
    to_s: header.to_s,
    rows: header.rows,
    kind: header.kind,
    axis: header.axis,
    ...(header.x_first && { x_first: times(header.x_first.offset) }),
    ...(header.x_last && { x_last: times(header.x_last.offset) }),
    t_first_s: times(header.t_first_s.offset),
    t_last_s: times(header.t_last_s.offset),
    channels: header.channels.map((channel) => {
      const Counts = channel.dtype === 'int32' ? Int32Array : Int16Array
      const values = (offset: number) => {
        const counts = new Counts(bytes, start + offset, bins)
        return Float64Array.from(counts, (n) => (n === channel.missing ? NaN : n * channel.scale))
      }
      const min = values(channel.min_offset)
      const same = channel.min_offset === channel.max_offset
      return {
        name: channel.name,
        unit: channel.unit,
        min,
        max: same ? min : values(channel.max_offset),
      }
    }),
  }
}

/** A series that came as JSON, within another answer. */
export function seriesOf(json: components['schemas']['Series']): Series {
  const values = (numbers: (number | null)[]) => Float64Array.from(numbers, (n) => n ?? NaN)
  return {
    from_s: json.from_s,
    to_s: json.to_s,
    rows: json.rows,
    kind: json.kind,
    axis: json.axis,
    ...(json.x_first && { x_first: Float64Array.from(json.x_first) }),
    ...(json.x_last && { x_last: Float64Array.from(json.x_last) }),
    t_first_s: Float64Array.from(json.t_first_s),
    t_last_s: Float64Array.from(json.t_last_s),
    channels: json.channels.map(({ name, unit, min, max }) => {
      const least = values(min)
      return { name, unit, min: least, max: json.kind === 'rows' ? least : values(max) }
    }),
  }
}

/** The same series in at most so many bins; each keeps its least and greatest value. */
export function coarser(series: Series, bins: number): Series {
  const each = Math.ceil(series.t_first_s.length / bins)
  if (each <= 1) return series
  const groups = Array.from(
    { length: Math.ceil(series.t_first_s.length / each) },
    (_, i) => [i * each, Math.min((i + 1) * each, series.t_first_s.length)] as const,
  )
  const extreme = (values: Float64Array, of: (...values: number[]) => number) =>
    Float64Array.from(groups, ([from, to]) => {
      const valid = values.subarray(from, to).filter((value) => !Number.isNaN(value))
      return valid.length > 0 ? of(...valid) : NaN
    })
  return {
    ...series,
    kind: 'minmax',
    t_first_s: Float64Array.from(groups, ([from]) => series.t_first_s[from] ?? NaN),
    t_last_s: Float64Array.from(groups, ([, to]) => series.t_last_s[to - 1] ?? NaN),
    channels: series.channels.map(({ name, unit, min, max }) => ({
      name,
      unit,
      min: extreme(min, Math.min),
      max: extreme(max, Math.max),
    })),
  }
}

/* Goal: the binary series is read as backend/rides/traces/trace.py describes it. The bytes are laid
   out here by hand from that description. */
import { expect, it } from 'vitest'
import { coarser, readSeries, seriesOf } from './series'

function block(header: object, body: ArrayBuffer): ArrayBuffer {
  let text = JSON.stringify(header)
  text = text.padEnd(Math.ceil((8 + text.length) / 8) * 8 - 8, ' ')
  const bytes = new Uint8Array(8 + text.length + body.byteLength)
  bytes.set(new TextEncoder().encode('SPV1'))
  new DataView(bytes.buffer).setUint32(4, text.length, true)
  bytes.set(new TextEncoder().encode(text), 8)
  bytes.set(new Uint8Array(body), 8 + text.length)
  return bytes.buffer
}

it('gives physical values, missing as NaN', () => {
  const body = new ArrayBuffer(48)
  new Float64Array(body, 0, 2).set([0, 10])
  new Float64Array(body, 16, 2).set([9, 19])
  new Int16Array(body, 32, 2).set([100, -32768])
  new Int16Array(body, 40, 2).set([9500, -32768])
  const channel = {
    name: 'rider_torque_nm',
    unit: 'Nm',
    scale: 0.01,
    dtype: 'int16',
    missing: -32768,
    min_offset: 32,
    max_offset: 40,
  }
  const header = {
    from_s: 0,
    to_s: 20,
    rows: 2000,
    bins: 2,
    kind: 'minmax',
    axis: 'distance',
    x_first: { dtype: 'float64', offset: 16 },
    x_last: { dtype: 'float64', offset: 16 },
    t_first_s: { dtype: 'float64', offset: 0 },
    t_last_s: { dtype: 'float64', offset: 16 },
    channels: [channel],
  }

  const series = readSeries(block(header, body))

  expect([...series.t_last_s]).toEqual([9, 19])
  expect([...(series.x_first ?? [])]).toEqual([9, 19])
  expect(series.channels[0]?.min[0]).toBeCloseTo(1)
  expect(series.channels[0]?.max[0]).toBeCloseTo(95)
  expect(series.channels[0]?.max[1]).toBeNaN()
})

it('refuses bytes that are something else', () => {
  expect(() => readSeries(new TextEncoder().encode('{"detail": 1}').buffer)).toThrow('not a series')
})

const json = {
  from_s: 0,
  to_s: 5,
  rows: 5,
  bins: 5,
  kind: 'rows' as const,
  axis: 'time' as const,
  x_first: null,
  x_last: null,
  t_first_s: [0, 1, 2, 3, 4],
  t_last_s: [0, 1, 2, 3, 4],
  channels: [{ name: 'a', unit: 'Nm', min: [1, 9, null, null, 4], max: [1, 9, null, null, 4] }],
}

it('reads a series within another answer, missing as NaN', () => {
  const [channel] = seriesOf(json).channels

  expect([...(channel?.min ?? [])]).toEqual([1, 9, NaN, NaN, 4])
  expect(channel?.max).toBe(channel?.min)
})

it('keeps the extremes of every bin where bins are taken together', () => {
  const coarse = coarser(seriesOf(json), 3)

  expect([...coarse.t_first_s]).toEqual([0, 2, 4])
  expect([...coarse.t_last_s]).toEqual([1, 3, 4])
  expect([...(coarse.channels[0]?.min ?? [])]).toEqual([1, NaN, 4])
  expect([...(coarse.channels[0]?.max ?? [])]).toEqual([9, NaN, 4])
  expect(coarser(seriesOf(json), 5).kind).toBe('rows')
})

/* Goal: bytes of the live socket become the rows the unit sent, and nothing else. The layout is the
   one written down for the socket: u32 seq, u32 lost, u64 t0_us, u16 rows, u16 channels, i16[]. */
import { describe, expect, it } from 'vitest'
import { readFrame, valueOf } from './frame'
import { TraceBuffer } from './trace_buffer'

export function frameBytes(
  seq: number,
  lost: number,
  t0_us: number,
  channels: number,
  counts: number[],
): ArrayBuffer {
  const view = new DataView(new ArrayBuffer(20 + 2 * counts.length))
  view.setUint32(0, seq, true)
  view.setUint32(4, lost, true)
  view.setBigUint64(8, BigInt(t0_us), true)
  view.setUint16(16, counts.length / channels, true)
  view.setUint16(18, channels, true)
  counts.forEach((count, i) => view.setInt16(20 + 2 * i, count, true))
  return view.buffer
}

const header = {
  type: 'stream' as const,
  epoch: 1,
  rate_hz: 100,
  period_us: 10_000,
  channels: [
    { name: 'speed_kmh', unit: 'km/h', scale: 0.01 },
    { name: 'fuzzy_gain', unit: '', scale: 0.00005 },
  ],
}

describe('a frame', () => {
  it('is read field by field', () => {
    const frame = readFrame(frameBytes(7, 3, 5_000_000_000, 2, [2500, 6000, 2501, -32768]))

    expect(frame).toMatchObject({ seq: 7, lost_rows: 3, t0_s: 5000, rows: 2, channels: 2 })
    expect([...(frame?.counts ?? [])]).toEqual([2500, 6000, 2501, -32768])
  })

  it('whose length contradicts its header is dropped', () => {
    const bytes = frameBytes(1, 0, 0, 2, [1, 2, 3, 4])

    expect(readFrame(bytes.slice(0, -2))).toBeNull()
    expect(readFrame(new ArrayBuffer(3))).toBeNull()
  })

  it('has missing values, which are never zero', () => {
    expect(valueOf(-32768, 0.01)).toBeNull()
    expect(valueOf(2500, 0.01)).toBeCloseTo(25)
  })
})

describe('the buffer of a strip', () => {
  const buffer = () => {
    const made = new TraceBuffer(1)
    made.reset(header)
    return made
  }
  const append = (to: TraceBuffer, lost: number, t0_us: number, counts: number[]) => {
    const frame = readFrame(frameBytes(0, lost, t0_us, 2, counts))
    if (frame) to.append(frame)
  }

  it('breaks its lines where rows were lost', () => {
    const strip = buffer()
    append(strip, 0, 0, [100, 1])
    append(strip, 5, 60_000, [200, 2])

    expect(strip.columns[0]).toEqual([1, null, 2])
    expect(strip.times[1]).toBeCloseTo(0.05)
  })

  it('keeps its window and no more than a fifth beyond', () => {
    const strip = buffer()
    for (let i = 0; i < 1000; i++) append(strip, 0, i * 10_000, [i, i])

    expect(strip.times.length).toBeGreaterThanOrEqual(100)
    expect(strip.times.length).toBeLessThanOrEqual(122)
    expect(strip.end_s).toBeCloseTo(9.99)
  })

  it('starts over when time runs backwards, because the unit restarted', () => {
    const strip = buffer()
    append(strip, 0, 9_000_000, [1, 1])
    append(strip, 0, 10_000, [2, 2])

    expect(strip.times).toEqual([0.01])
  })
})

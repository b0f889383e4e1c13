// Bytes of the live socket -> rows. Little-endian: u32 seq, u32 lost_rows, u64 t0_us, u16 rows,
// u16 channels, i16[rows * channels]; a value is count * scale, and -32768 says it is missing.

export interface StreamChannel {
  name: string
  unit: string
  scale: number
}

export interface StreamHeader {
  type: 'stream'
  epoch: number
  rate_hz: number
  period_us: number
  channels: StreamChannel[]
}

export interface StreamState {
  type: 'state'
  state: string
  reason: string | null
}

/** The unit or a channel does not exist: requesting again at once will not help. */
export interface StreamError {
  type: 'error'
  code: string
  detail: string
}

export interface StreamFrame {
  seq: number
  lost_rows: number
  t0_s: number
  rows: number
  channels: number
  counts: Int16Array | number[]
}

const HEADER_BYTES = 20
export const MISSING = -32768

/** One binary frame, or null when its length contradicts its header. */
export function readFrame(bytes: ArrayBuffer): StreamFrame | null {
  if (bytes.byteLength < HEADER_BYTES) return null
  const view = new DataView(bytes)
  const rows = view.getUint16(16, true)
  const channels = view.getUint16(18, true)
  if (bytes.byteLength !== HEADER_BYTES + 2 * rows * channels) return null
  return {
    seq: view.getUint32(0, true),
    lost_rows: view.getUint32(4, true),
    t0_s: Number(view.getBigUint64(8, true)) / 1e6,
    rows,
    channels,
    counts: new Int16Array(bytes.slice(HEADER_BYTES)),
  }
}

/** The value of a count, or null when it is missing. */
export function valueOf(count: number | undefined, scale: number): number | null {
  return count === undefined || count === MISSING ? null : count * scale
}

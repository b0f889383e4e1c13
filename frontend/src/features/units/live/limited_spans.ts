// Where something limited the motor in the rows of a stream.
import { severityOf } from '$shared/device/fault_text'
import { faultFlags, flagNames } from '$shared/stream/flags'
import type { Column } from '$shared/stream/trace_buffer'

/** Limits that hold back who pedals; ramps and tapers belong to how a mode feels. The server's list
    of a ride's cuts is the same. */
const HOLD = [
  'speed_cutoff',
  'brake',
  'motor_torque',
  'battery_current',
  'motor_speed',
  'battery_voltage',
  'temperature',
  'fault',
  'market',
]
/** One that returns within this time goes on: the two strokes of a turn leave holes. */
const HOLE_S = 1
const LEAST_S = 0.2

export interface LimitedSpan {
  from_s: number
  /** Infinity while it goes on. */
  to_s: number
  /** Of limit_flags, in their order; none where only a fault limited it. */
  limits: string[]
  /** Of fault_flags; without warnings, which hold nothing back. */
  faults: string[]
}

export interface LimitRows {
  times: readonly number[]
  limits: Column | undefined
  faults: Column | undefined
  faults_high: Column | undefined
}

/** Names of what a row's flags hold back by. */
export function holding(limits: number | null, faults: number | null) {
  const names = flagNames('fault_flags', faults).filter((name) => severityOf(name) !== 'warning')
  const active = flagNames('limit_flags', limits).filter((name) => HOLD.includes(name))
  return { limits: active.filter((name) => name !== 'fault' || names.length === 0), faults: names }
}

/** Every stretch in which something limited the motor, in order of time. */
export function stretches({ times, limits, faults, faults_high }: LimitRows): LimitedSpan[] {
  const spans: { from_s: number; to_s: number; limits: number; faults: number }[] = []
  for (const [row, at_s] of times.entries()) {
    const limit_word = limits?.[row] ?? 0
    const high = faults_high?.[row] ?? null
    const fault_word = faultFlags({ fault_flags: faults?.[row], fault_flags_high: high }) ?? 0
    const active = holding(limit_word, fault_word)
    if (active.limits.length === 0 && active.faults.length === 0) continue
    const last = spans[spans.length - 1]
    // A fault is separated from the limit before it.
    if (last && at_s - last.to_s <= HOLE_S && (last.faults === 0) === (fault_word === 0)) {
      last.to_s = at_s
      last.limits |= limit_word
      last.faults |= fault_word
    } else {
      spans.push({ from_s: at_s, to_s: at_s, limits: limit_word, faults: fault_word })
    }
  }
  const end_s = times[times.length - 1] ?? 0
  return spans
    .filter(({ from_s, to_s }) => to_s - from_s >= LEAST_S)
    .map((one) => ({
      from_s: one.from_s,
      to_s: end_s - one.to_s <= HOLE_S ? Infinity : one.to_s,
      ...holding(one.limits, one.faults),
    }))
}

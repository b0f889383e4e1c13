// What the ride page draws: rows of channels, time marks, and bins as points of a line.
import { niceStep } from '$shared/charts/strip_chart'
import type { Ride } from '$shared/api/types'
import { clock } from '$shared/i18n/locale.svelte'

export interface TraceLine {
  channel: string
  token: string
  /** Its name beside the others of its row, where it is not the channel's. */
  name?: string
}

export interface TraceRow {
  key: string
  unit: string
  lines: TraceLine[]
}

// Each row shows the first of its alternatives that the ride has. What a unit asked of its motor is
// drawn behind what the motor gave.
const rows: (TraceRow & { instead?: TraceRow })[] = [
  { key: 'speed', unit: 'km/h', lines: [{ channel: 'speed_kmh', token: 'speed' }] },
  { key: 'rider_torque', unit: 'Nm', lines: [{ channel: 'rider_torque_nm', token: 'rider' }] },
  {
    key: 'motor_torque_crank',
    unit: 'Nm',
    lines: [
      { channel: 'motor_torque_demanded_crank_nm', token: 'motor-faint', name: 'motor_asked' },
      { channel: 'motor_torque_crank_nm', token: 'motor', name: 'motor_given' },
    ],
    instead: {
      key: 'motor_torque',
      unit: 'Nm',
      lines: [
        { channel: 'motor_torque_demanded_nm', token: 'motor-faint', name: 'motor_asked' },
        { channel: 'motor_torque_nm', token: 'motor', name: 'motor_given' },
      ],
    },
  },
  {
    key: 'power',
    unit: 'W',
    lines: [
      { channel: 'rider_power_w', token: 'rider' },
      { channel: 'motor_power_w', token: 'motor' },
    ],
  },
  { key: 'gain', unit: '', lines: [{ channel: 'fuzzy_gain', token: 'gain' }] },
  { key: 'cadence', unit: 'rpm', lines: [{ channel: 'cadence_rpm', token: 'cadence' }] },
  { key: 'heart_rate', unit: 'bpm', lines: [{ channel: 'heart_rate_bpm', token: 'battery' }] },
  { key: 'altitude', unit: 'm of altitude', lines: [{ channel: 'altitude_m', token: 'battery' }] },
]
const expected = ['speed', 'rider_torque', 'motor_torque_crank', 'power', 'gain']

/** The rows a ride with these channels can show, and the expected ones it cannot. A motor torque
    that was only asked for has a row that says so. */
export function rowsFor(
  channels: string[],
  meaning: Ride['motor_torque_meaning'] = null,
): { shown: TraceRow[]; missing: string[] } {
  const has = (row: TraceRow): TraceRow => ({
    ...row,
    key: row.key.startsWith('motor') && meaning === 'demanded' ? `${row.key}_asked` : row.key,
    lines: row.lines.filter((line) => channels.includes(line.channel)),
  })
  const shown: TraceRow[] = []
  const missing: string[] = []
  for (const row of rows) {
    const found = [row, row.instead].flatMap((r) => (r ? [has(r)] : [])).find((r) => r.lines.length)
    if (found) shown.push(found)
    else if (expected.includes(row.key)) missing.push(row.key)
  }
  return { shown, missing }
}

/** Bins as a line that touches the least and the greatest value of each. NaN breaks the line. */
export function binLine(
  first_s: Float64Array,
  last_s: Float64Array,
  min: Float64Array,
  max: Float64Array,
): { x: Float64Array; y: Float64Array } {
  if (min === max) return { x: first_s, y: min }
  const x = new Float64Array(2 * min.length)
  const y = new Float64Array(2 * min.length)
  for (let i = 0; i < min.length; i++) {
    x[2 * i] = first_s[i] ?? NaN
    x[2 * i + 1] = last_s[i] ?? NaN
    y[2 * i] = min[i] ?? NaN
    y[2 * i + 1] = max[i] ?? NaN
  }
  return { x, y }
}

const STEPS_S = [1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200, 14400, 28800]

/** About `count` round moments in a window, with their texts. */
export function timeTicks(
  from_s: number,
  to_s: number,
  count: number,
): { at: number[]; text: string[] } {
  const rough = (to_s - from_s) / count
  const step = rough < 0.7 ? niceStep(rough) : (STEPS_S.find((s) => s >= rough) ?? niceStep(rough))
  const at: number[] = []
  for (let i = Math.ceil(from_s / step - 1e-9); i * step <= to_s + 1e-9; i++) at.push(i * step)
  return { at, text: at.map((t) => moment(t, step)) }
}

/** A moment of the ride, with decimals where whole seconds would repeat. */
export function moment(t_s: number, step_s = 1): string {
  if (step_s >= 1) return clock(t_s)
  const digits = Math.ceil(-Math.log10(step_s))
  const whole = Math.floor(t_s + 1e-9)
  return `${clock(whole)}${(t_s - whole).toFixed(digits).slice(1)}`
}

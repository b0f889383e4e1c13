// What the ride page draws: rows of the channels that a ride has.
import type { Ride } from '$shared/api/types'
import type { TraceRow } from '$shared/charts/traces/trace_line'
import type { Locale } from '$shared/i18n/locale.svelte'

// Each row shows the first of its alternatives that the ride has. What a unit demanded of its motor
// is drawn behind what the motor gave.
const rows: (TraceRow & { instead?: TraceRow })[] = [
  { key: 'speed', unit: 'km/h', lines: [{ channel: 'speed_kmh', token: 'speed' }] },
  { key: 'rider_torque', unit: 'Nm', lines: [{ channel: 'rider_torque_nm', token: 'rider' }] },
  {
    key: 'motor_torque_crank',
    unit: 'Nm',
    lines: [
      { channel: 'motor_torque_demanded_crank_nm', token: 'motor-faint', name: 'motor_demanded' },
      { channel: 'motor_torque_crank_nm', token: 'motor', name: 'motor_delivered' },
    ],
    instead: {
      key: 'motor_torque',
      unit: 'Nm',
      lines: [
        { channel: 'motor_torque_demanded_nm', token: 'motor-faint', name: 'motor_demanded' },
        { channel: 'motor_torque_nm', token: 'motor', name: 'motor_delivered' },
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
    that was only demanded has a row that says so. */
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
    const match = [row, row.instead].flatMap((r) => (r ? [has(r)] : [])).find((r) => r.lines.length)
    if (match) shown.push(match)
    else if (expected.includes(row.key)) missing.push(row.key)
  }
  return { shown, missing }
}

interface RowsOfRide {
  /** In the order they are drawn in. */
  all: TraceRow[]
  /** Keys of those shown at first. */
  usual: string[]
  /** Keys of the expected ones that the ride lacks. */
  missing: string[]
}

/** Every channel of a ride in a row: the usual rows, then each other channel in one of its own. */
export function rowsOf({ channels, motor_torque_meaning }: Ride): RowsOfRide {
  const { shown, missing } = rowsFor(
    channels.map(({ name }) => name),
    motor_torque_meaning,
  )
  const drawn = new Set(shown.flatMap((row) => row.lines.map(({ channel }) => channel)))
  const others = channels
    .filter(({ name }) => !drawn.has(name))
    .map(({ name, unit }) => ({ key: name, unit, lines: [{ channel: name, token: 'battery' }] }))
  const all = [...shown, ...others]
  const usual = (shown.length > 0 ? shown : all.slice(0, 3)).map(({ key }) => key)
  return { all, usual, missing }
}

/** What a row is called: its own name, else its channel's, else the channel as the file has it. */
export function rowName(key: string, { lookup }: Locale): string {
  const channel = lookup(`channel.${key}`, key.replaceAll('_', ' '))
  return lookup(`trace.${key}`, channel)
}

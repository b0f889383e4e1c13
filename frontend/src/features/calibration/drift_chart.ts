// Where rides, the trend's band and calibrations stand in the picture of the zero's drift.
import type { SensorDrift } from '$shared/api/types'
import { BLUE_TO_RED, colourAt, cssColour } from '$shared/charts/colour_scale'

export const TALL = 230
/** Room for the numbers at the left and the dates below. */
export const MARGIN = { left: 44, right: 12, top: 14, bottom: 24 }
// Of a zero that holds the levels beside it are seen; of a wide band its line.
const RANGE_NM = 1.2
const DAY_MS = 86_400_000
const DATE_PX = 110

export interface Dot {
  x: number
  y: number
  ride_id: number
  /** Null for a ride without a temperature. */
  colour: string | null
  counts: boolean
}

export interface Picture {
  dots: Dot[]
  bands: { line: string; area: string }[]
  calibrations: { x: number; seq: number }[]
  levels: { y: number; kind: 'zero' | 'watch' | 'act'; nm: number }[]
  dates: { x: number; at_ms: number }[]
  coldest_degc: number | null
  warmest_degc: number | null
  today_x: number
}

const ms = (iso: string) => Date.parse(iso)

/** now_ms: the forecast is drawn behind it. width: of the whole picture in pixels. */
export function pictureOf(drift: SensorDrift, width: number, now_ms: number): Picture {
  const rides = drift.rides.flatMap((ride) =>
    ride.zero_nm === null ? [] : [{ ...ride, zero_nm: ride.zero_nm, at_ms: ms(ride.started_at) }],
  )
  const bands = drift.trend?.bands ?? []
  const points = bands.flat()
  const times = [...rides.map(({ at_ms }) => at_ms), ...points.map(({ at }) => ms(at)), now_ms]
  const first = Math.min(...times)
  const span = Math.max(Math.max(...times) - first, DAY_MS)
  // A ride that lies apart stands at the edge: it may not make all others flat.
  const counting = rides.filter(({ left_out }) => left_out !== 'apart')
  const heights = [...counting, ...points].map(({ zero_nm }) => zero_nm)
  const low = Math.min(-RANGE_NM, ...heights) - 0.2
  const high = Math.max(RANGE_NM, ...heights) + 0.2
  const wide = Math.max(width - MARGIN.left - MARGIN.right, 1)
  const tall = TALL - MARGIN.top - MARGIN.bottom
  const x = (at_ms: number) => MARGIN.left + (wide * (at_ms - first)) / span
  const y = (nm: number) => MARGIN.top + (tall * (high - nm)) / (high - low)
  const degrees = rides.flatMap(({ temperature_degc: degc }) => (degc === null ? [] : [degc]))
  const [coldest, warmest] = [Math.min(...degrees), Math.max(...degrees)]
  const colour = (degc: number | null) =>
    degc === null
      ? null
      : cssColour(colourAt(BLUE_TO_RED, (degc - coldest) / Math.max(warmest - coldest, 1)))
  const path = (corners: [string, number][]) =>
    corners
      .map(([at, nm], i) => `${i ? 'L' : 'M'}${x(ms(at)).toFixed(1)} ${y(nm).toFixed(1)}`)
      .join('')
  const { watch_nm: watch, act_nm: act } = drift
  const levels = [
    { kind: 'zero', nm: 0 } as const,
    ...[watch, -watch].map((nm) => ({ kind: 'watch', nm }) as const),
    ...[act, -act].map((nm) => ({ kind: 'act', nm }) as const),
  ]
  // A day is named once.
  const count = Math.max(1, Math.floor(Math.min(wide / DATE_PX, span / DAY_MS)))
  return {
    dots: rides.map((ride) => ({
      x: x(ride.at_ms),
      y: y(Math.min(high, Math.max(low, ride.zero_nm))),
      ride_id: ride.ride_id,
      colour: colour(ride.temperature_degc),
      counts: ride.left_out === null,
    })),
    bands: bands.map((band) => ({
      line: path(band.map(({ at, zero_nm }) => [at, zero_nm])),
      area: `${path([
        ...band.map(({ at, high_nm }): [string, number] => [at, high_nm]),
        ...[...band].reverse().map(({ at, low_nm }): [string, number] => [at, low_nm]),
      ])}Z`,
    })),
    calibrations: drift.calibrations
      .map(({ created_at, seq }) => ({ x: x(ms(created_at)), seq }))
      .filter((line) => line.x >= MARGIN.left),
    levels: levels
      .filter(({ nm }) => nm > low && nm < high)
      .map((level) => ({ ...level, y: y(level.nm) })),
    dates: Array.from({ length: count }, (_, i) => {
      const at_ms = first + (span * (i + 0.5)) / count
      return { x: x(at_ms), at_ms }
    }),
    coldest_degc: degrees.length ? coldest : null,
    warmest_degc: degrees.length ? warmest : null,
    today_x: x(now_ms),
  }
}

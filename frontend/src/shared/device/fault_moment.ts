// The picture of what a bike did around a fault: where its lines run, where nothing was read, and
// what it says in numbers.
import type { FaultMoment } from '../api/types'

export const [MOMENT_WIDTH, MOMENT_HEIGHT] = [300, 60]
export const [FROM_S, TO_S] = [-2, 1]
const TOP_NM_LEAST = 20
const NOISE_NM = 2

type Samples = readonly (number | null)[]

/** Newton metres at the picture's lower and upper edge: round, and zero is always on it. */
export function scaleOf(...lines: Samples[]): { low: number; top: number } {
  const present = lines.flat().filter((value) => value !== null)
  const top = Math.max(TOP_NM_LEAST, ...present)
  const low = Math.min(0, ...present)
  // An unloaded sensor reads a little around zero: that is no backward push.
  return { low: low < -NOISE_NM ? Math.floor(low / 10) * 10 : 0, top: Math.ceil(top / 20) * 20 }
}

export const placeX = (at_s: number) => (MOMENT_WIDTH * (at_s - FROM_S)) / (TO_S - FROM_S)

/** Samples as an SVG path, top down; a sample without a reading breaks the line. */
export function momentPath(
  at_s: readonly number[],
  values: Samples,
  { low, top }: { low: number; top: number },
): string {
  let drawing = false
  return at_s
    .map((at, i) => {
      const value = values[i] ?? null
      const command = value === null ? '' : drawing ? 'L' : 'M'
      drawing = value !== null
      if (value === null) return ''
      const y = MOMENT_HEIGHT * (1 - (value - low) / (top - low))
      return `${command}${placeX(at).toFixed(1)} ${y.toFixed(1)}`
    })
    .join('')
}

/** Stretches [from, to] in seconds in which a line has no reading, each to the sample after it. */
export function unread(at_s: readonly number[], values: Samples): [number, number][] {
  const gaps: [number, number][] = []
  at_s.forEach((at, i) => {
    if (values[i] != null) return
    const last = gaps.at(-1)
    const until = at_s[i + 1] ?? at
    if (last && last[1] === at) last[1] = until
    else gaps.push([at, until])
  })
  return gaps
}

/** The moment in numbers; null where nothing was read. unread_from_s: from where on there is no
    reading of the rider to the end. motor_before: when the rider was read last. */
export interface MomentFigures {
  rider_least: number | null
  rider_most: number | null
  unread_from_s: number | null
  motor_before: number | null
  motor_after: number | null
}

export function figuresOf(moment: FaultMoment): MomentFigures {
  const { at_s, rider_torque_nm: rider, motor_torque_nm: motor } = moment
  const gap = unread(at_s, rider).at(-1)
  const unread_from_s = gap && gap[1] === at_s.at(-1) ? gap[0] : null
  const end_s = Math.min(0, unread_from_s ?? 0)
  const before = (values: Samples) =>
    values.filter((value, i) => value !== null && (at_s[i] ?? 0) < end_s) as number[]
  const pushed = before(rider)
  return {
    rider_least: pushed.length ? Math.min(...pushed) : null,
    rider_most: pushed.length ? Math.max(...pushed) : null,
    unread_from_s,
    motor_before: before(motor).at(-1) ?? null,
    motor_after: motor.at(-1) ?? null,
  }
}

// Torque round the crank: the last turns of a stream as a curve in polar coordinates.
import type { Column } from '$shared/stream/trace_buffer'

interface Point {
  angle_deg: number
  torque_nm: number
  /** How far the crank turned until the next row. */
  step_deg: number
}

export interface Turns {
  /** Each turn's points, oldest first, angles from the left crank up; the last one is under way. */
  turns: Point[][]
  torque_nm_max: number
  /** Share of the work done while the left crank goes down; null while nothing was pushed. */
  left: number | null
}

const TURNS = 3
const FULL_DEG = 360
const GAP_DEG = 90 // from row to row; more is a gap in the stream

/** The last three whole turns and the one under way; null before the first whole one. */
export function lastTurns(angles: Column, torques: Column): Turns | null {
  const turns: Point[][] = [[]]
  let next_deg: number | null = null
  for (let row = angles.length - 1; row >= 0 && turns.length <= TURNS + 1; row--) {
    const angle_deg = angles[row] ?? null
    const torque_nm = torques[row] ?? null
    if (angle_deg === null || torque_nm === null) break
    const ahead = next_deg === null ? 0 : (next_deg - angle_deg + FULL_DEG) % FULL_DEG
    if (ahead > GAP_DEG && ahead < FULL_DEG - GAP_DEG) break
    if (next_deg === angle_deg) continue // it stands
    const step_deg = ahead > GAP_DEG ? ahead - FULL_DEG : ahead
    if (next_deg !== null && step_deg > 0 && angle_deg > next_deg) turns.push([])
    turns[turns.length - 1]?.unshift({ angle_deg, torque_nm, step_deg })
    next_deg = angle_deg
  }
  turns.reverse()
  turns.shift() // its beginning lies before the rows that are here
  const complete = turns.slice(0, -1).flat()
  if (complete.length === 0) return null
  const work = (points: Point[]) =>
    points.reduce((sum, { torque_nm, step_deg }) => sum + Math.max(0, torque_nm) * step_deg, 0)
  const all = work(complete)
  return {
    turns,
    torque_nm_max: Math.max(0, ...turns.flat().map(({ torque_nm }) => torque_nm)),
    left: all > 0 ? work(complete.filter(({ angle_deg }) => angle_deg < FULL_DEG / 2)) / all : null,
  }
}

/** Where an angle and a radius lie, seen from the bike's left side: the cranks turn against the
    clock, and the left foot pushes down on the left. */
export function place(angle_deg: number, radius: number): [number, number] {
  const angle = (angle_deg * Math.PI) / 180
  return [-radius * Math.sin(angle), -radius * Math.cos(angle)]
}

/** A turn as a path. per_nm: the radius of a newton metre. */
export function pathOf(turn: readonly Point[], per_nm: number): string {
  const points = turn.map(({ angle_deg, torque_nm }) => {
    const [x, y] = place(angle_deg, per_nm * Math.max(0, torque_nm))
    return `${x.toFixed(1)} ${y.toFixed(1)}`
  })
  return points.length > 0 ? `M${points.join('L')}` : ''
}

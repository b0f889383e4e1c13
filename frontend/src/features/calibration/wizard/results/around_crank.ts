// What the new scale leaves of the loads of either pedal, over the crank's angle.
import type { Job, Side } from '../job/types'

export interface AtAngle {
  capture: number
  side: Side
  angle_deg: number
  /** Per cent of the torque that the same mass makes on a level crank. */
  left_pct: number
}

/** One a load of the fit. */
export function aroundCrank(job: Job): AtAngle[] {
  const states = new Map(job.captures.map(({ number, state }) => [number, state]))
  return (job.worked?.fit?.residuals ?? []).flatMap(({ capture, load_nm, residual_nm }) => {
    const state = states.get(capture)
    if (!state?.side || load_nm <= 0) return []
    const angle_deg = state.crank_angle_deg ?? 0
    const level_nm = load_nm / Math.cos((angle_deg * Math.PI) / 180)
    return [{ capture, side: state.side, angle_deg, left_pct: (100 * residual_nm) / level_nm }]
  })
}

/** The means of one pedal, a point an angle, in their order. */
export function meansOf(points: readonly AtAngle[], side: Side): Omit<AtAngle, 'capture'>[] {
  const own = points.filter((one) => one.side === side)
  const angles = [...new Set(own.map((one) => one.angle_deg))].sort((a, b) => a - b)
  return angles.map((angle_deg) => {
    const here = own.filter((one) => one.angle_deg === angle_deg).map((one) => one.left_pct)
    return { side, angle_deg, left_pct: here.reduce((sum, one) => sum + one, 0) / here.length }
  })
}

// Where the points of a power curve stand in its picture.
import type { BestMean } from '$shared/api/types'

export const WIDE = 300
export const TALL = 100

/** From the shortest stretch at the left to the longest at the right, by logarithm; power from zero
    at the bottom. */
export function placed(curve: readonly BestMean[]): [number, number][] {
  const first = Math.log(curve[0]?.duration_s ?? 1)
  const span = Math.log(curve.at(-1)?.duration_s ?? 1) - first || 1
  const top = Math.max(...curve.map(({ power_w }) => power_w), 1)
  return curve.map(({ duration_s, power_w }) => [
    (WIDE * (Math.log(duration_s) - first)) / span,
    TALL - (TALL * power_w) / top,
  ])
}

export function curvePath(points: readonly [number, number][]): string {
  return points.map(([x, y], at) => `${at ? 'L' : 'M'}${x.toFixed(1)} ${y.toFixed(1)}`).join('')
}

// The output sets of a table as lines to draw. What the gain is, the unit's own law says.
import type { Why } from '$shared/api/types'
import { LABELS } from '$shared/config/parameter_text'

type Point = [gain: number, height: number]
const GAIN_MAX = 0.5
const STEPS = 200

export interface GainShape {
  /** Each set's triangle, within the universe. */
  sets: Point[][]
  /** How far each set fired, 0 to 1: the most of its rules, or with a mean their sum. */
  levels: number[]
  /** The clipped sets under one line. */
  union: Point[]
}

export function gainShape(peaks: number[], rules: Why['rules'], mean: boolean): GainShape {
  const levels = LABELS.map((label) => {
    const weights = rules.filter((rule) => rule.label === label).map(({ weight }) => weight)
    return mean ? weights.reduce((sum, weight) => sum + weight, 0) : Math.max(0, ...weights)
  })
  const at = (i: number) => peaks[i] ?? 0
  // The outermost sets are as wide outwards as inwards.
  const left = (i: number) => (i > 0 ? at(i) - at(i - 1) : at(1) - at(0))
  const right = (i: number) => (i < 4 ? at(i + 1) - at(i) : at(4) - at(3))
  const height = (i: number, gain: number) =>
    Math.max(0, 1 - (gain < at(i) ? (at(i) - gain) / left(i) : (gain - at(i)) / right(i)))
  const inside = (gain: number) => Math.min(GAIN_MAX, Math.max(0, gain))
  const sets = peaks.map((peak, i) =>
    [peak - left(i), peak, peak + right(i)]
      .map(inside)
      .map((gain): Point => [gain, height(i, gain)]),
  )
  const union = Array.from({ length: STEPS + 1 }, (_, k): Point => {
    const gain = (k / STEPS) * GAIN_MAX
    return [gain, Math.max(...levels.map((level, i) => Math.min(level, height(i, gain))))]
  })
  return { sets, levels, union: [[0, 0], ...union, [GAIN_MAX, 0]] }
}

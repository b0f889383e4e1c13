// What is done to a block of rules at once. Rules hold labels: the sums are made in gain, and each
// rule takes the label whose gain is nearest.
import type { RuleLabel } from '$shared/api/types'
import { LABELS } from '$shared/config/parameter_text'
import { inBlock, mapBlock, type Block, type Rules } from './table'

/** The label whose gain is nearest; of two that are as near, the one nearer to `old`. */
export function nearestLabel(gains: readonly number[], gain: number, old: RuleLabel): RuleLabel {
  const from = LABELS.indexOf(old)
  const off = (i: number) => Math.abs((gains[i] ?? Infinity) - gain)
  const order = LABELS.map((_, i) => i).sort(
    // What differs by rounding alone is as near.
    (a, b) =>
      Math.round((off(a) - off(b)) * 1e9) || Math.abs(a - from) - Math.abs(b - from) || a - b,
  )
  return LABELS[order[0] ?? from] ?? old
}

type GainAt = (gain: number, row: number, column: number) => number

function mapGain(rules: Rules, block: Block, gains: readonly number[], target: GainAt): Rules {
  return mapBlock(rules, block, (label, row, column) =>
    nearestLabel(gains, target(gainOf(gains, label), row, column), label),
  )
}

function gainOf(gains: readonly number[], label: RuleLabel | undefined): number {
  return gains[label ? LABELS.indexOf(label) : -1] ?? NaN
}

/** Every rule of the block at its mean. */
export function levelled(rules: Rules, block: Block, gains: readonly number[]): Rules {
  const all = inBlock(rules, block).map((label) => gainOf(gains, label))
  const mean = all.reduce((sum, gain) => sum + gain, 0) / all.length
  return mapGain(rules, block, gains, () => mean)
}

/** Every rule's gain times a factor. */
export function scaled(
  rules: Rules,
  block: Block,
  gains: readonly number[],
  factor: number,
): Rules {
  return mapGain(rules, block, gains, (gain) => gain * factor)
}

/** A plane through the corners of the block, or through the ends of a row or a column. */
export function interpolated(rules: Rules, block: Block, gains: readonly number[]): Rules {
  const { top, bottom, left, right } = block
  const at = (row: number, column: number) => gainOf(gains, rules[row]?.[column])
  const share = (place: number, from: number, to: number) =>
    to > from ? (place - from) / (to - from) : 0
  return mapGain(rules, block, gains, (_, row, column) => {
    const [down, over] = [share(row, top, bottom), share(column, left, right)]
    const edgeValue = (edge: number) => at(edge, left) * (1 - over) + at(edge, right) * over
    return edgeValue(top) * (1 - down) + edgeValue(bottom) * down
  })
}

/** Each rule the mean of itself and its neighbours, also of those beside the block: itself four
    times, those beside it twice, those across once. */
export function smoothed(rules: Rules, block: Block, gains: readonly number[]): Rules {
  return mapGain(rules, block, gains, (_, row, column) => {
    let [sum, weights] = [0, 0]
    for (const down of [-1, 0, 1]) {
      for (const over of [-1, 0, 1]) {
        const label = rules[row + down]?.[column + over]
        if (!label) continue
        const weight = (down ? 1 : 2) * (over ? 1 : 2)
        sum += weight * gainOf(gains, label)
        weights += weight
      }
    }
    return sum / weights
  })
}

/** How many rules differ. */
export function moved(before: Rules, after: Rules): number {
  return before.flat().filter((label, i) => label !== after.flat()[i]).length
}

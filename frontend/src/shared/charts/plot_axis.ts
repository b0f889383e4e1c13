// An axis of a drawing: values to pixels, and the round values that it names.

export interface PlotAxis {
  low: number
  high: number
  from_px: number
  to_px: number
}

/** Where a value lies; what is outside lies at the end. */
export function pixelOf({ low, high, from_px, to_px }: PlotAxis, value: number): number {
  const share = Math.min(1, Math.max(0, (value - low) / (high - low)))
  return from_px + share * (to_px - from_px)
}

/** The nearest of increasing values to a pixel; null outside the axis. */
export function nearestTo(values: readonly number[], axis: PlotAxis, px: number): number | null {
  const share = (px - axis.from_px) / (axis.to_px - axis.from_px)
  if (!(share >= 0 && share <= 1)) return null
  const value = axis.low + share * (axis.high - axis.low)
  const after = values.findIndex((one) => one >= value)
  if (after <= 0) return after < 0 ? values.length - 1 : 0
  const [before = 0, next = 0] = [values[after - 1], values[after]]
  return value - before < next - value ? after - 1 : after
}

/** Round values of a range, about `count` of them, each with its text. */
export function roundTicks(low: number, high: number, count: number) {
  const step = niceStep((high - low) / count)
  const first = Math.ceil(low / step - 1e-9)
  const last = Math.floor(high / step + 1e-9)
  return Array.from({ length: Math.max(0, last - first + 1) }, (_, i) => {
    const value = Number(((first + i) * step).toPrecision(12))
    return { value, text: String(value) }
  })
}

/** `least`, or where the data leaves it a range that holds them and ends on round numbers. */
export function roundRange(
  min: number | null,
  max: number | null,
  least: [number, number],
): [number, number] {
  // A sensor's noise about zero must not make the axis jump.
  const slack = 0.03 * (least[1] - least[0])
  const within = (min ?? least[0]) >= least[0] - slack && (max ?? least[1]) <= least[1] + slack
  if (within) return least
  const low = Math.min(least[0], min ?? least[0])
  const high = Math.max(least[1], max ?? least[1])
  const step = niceStep((high - low) / 4)
  return [Math.floor(low / step + 1e-9) * step, Math.ceil(high / step - 1e-9) * step]
}

/** 1, 2 or 5 times a power of ten, at least `rough`. */
export function niceStep(rough: number): number {
  const power = 10 ** Math.floor(Math.log10(rough))
  const factor = [1, 2, 5, 10].find((f) => f * power >= rough - 1e-12) ?? 10
  return factor * power
}

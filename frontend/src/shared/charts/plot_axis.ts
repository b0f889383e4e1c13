// An axis of a drawing: values to pixels, and the round values that it names.
import { niceStep } from './strip_chart'

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

/** The nearest of increasing values to a pixel; null beside the axis. */
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

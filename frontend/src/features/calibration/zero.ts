// Whether the sensor is quiet enough to call its reading zero.
import type { Column } from '$shared/stream/trace_buffer'

export interface Quiet {
  mean: number
  deviation: number
  rows: number
}

/** Mean and standard deviation of the newest `rows` readings; null with fewer than that. */
export function quietOf(column: Column | undefined, rows: number): Quiet | null {
  const values = (column ?? []).slice(-rows).filter((value) => value !== null)
  if (values.length < rows) return null
  const mean = values.reduce((sum, value) => sum + value, 0) / rows
  const variance = values.reduce((sum, value) => sum + (value - mean) ** 2, 0) / (rows - 1)
  return { mean, deviation: Math.sqrt(variance), rows }
}

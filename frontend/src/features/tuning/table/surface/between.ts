// A picture between the lines of its grid.
import type { Picture } from './surface_shown'
import type { Place } from './trail.svelte'

/** A row of the picture at a speed, between its lines. */
export function rowAt(rows: number[][], speeds_kmh: number[], speed_kmh: number): number[] {
  const { low, high, share } = between(speeds_kmh, speed_kmh)
  const [a, b] = [rows[low] ?? [], rows[high] ?? []]
  return a.map((value, j) => value + share * ((b[j] ?? value) - value))
}

/** A column of the picture at a torque rate, between its lines. */
export function columnAt(rows: number[][], torque_rates: number[], rate: number): number[] {
  const { low, high, share } = between(torque_rates, rate)
  return rows.map((row) => (row[low] ?? NaN) + share * ((row[high] ?? NaN) - (row[low] ?? NaN)))
}

/** The picture's value at any place, between those of its grid. */
export function heightAt({ z, speeds_kmh, torque_rates }: Picture, place: Place): number {
  const row = rowAt(z, speeds_kmh, place.speed_kmh)
  return columnAt([row], torque_rates, place.torque_rate)[0] ?? NaN
}

function between(points: number[], value: number): { low: number; high: number; share: number } {
  const after = points.findIndex((point) => point >= value)
  if (after <= 0) {
    const end = after < 0 ? points.length - 1 : 0
    return { low: end, high: end, share: 0 }
  }
  const [from = 0, to = 1] = [points[after - 1], points[after]]
  return { low: after - 1, high: after, share: (value - from) / (to - from) }
}

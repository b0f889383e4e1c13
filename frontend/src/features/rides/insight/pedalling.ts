// Where torque round the crank and the cells of the gain stand in their pictures.
import type { RidePedalling } from '$shared/api/types'

export const WIDE = 360
export const TALL = 100
export const ROUND_DEG = 360

/** The greatest of both, for one scale from zero. */
export function topOf(...lines: (readonly number[])[]): number {
  return Math.max(1, ...lines.flat())
}

/** Bins of one turn as a line; torque below zero lies on the ground. */
export function linePath(values: readonly number[], top: number): string {
  const width = WIDE / values.length
  return values
    .map((value, at) => {
      const y = TALL - (TALL * Math.max(value, 0)) / top
      return `${at ? 'L' : 'M'}${((at + 0.5) * width).toFixed(1)} ${y.toFixed(1)}`
    })
    .join('')
}

/** The cells with any time, and the middle of the one with most: columns are speeds, rows gains. */
export function cellsOf(map: NonNullable<RidePedalling['gain']>) {
  const { speed_step_kmh, gain_step, seconds } = map
  const cells = seconds.flatMap((line, column) =>
    line.map((spent_s, row) => ({ column, row, spent_s })).filter(({ spent_s }) => spent_s > 0),
  )
  const most = cells.reduce((best, cell) => (cell.spent_s > best.spent_s ? cell : best))
  return {
    speed_step_kmh,
    gain_step,
    columns: seconds.length,
    rows: seconds[0]?.length ?? 0,
    cells: cells.map(({ spent_s, ...place }) => ({ ...place, share: spent_s / most.spent_s })),
    most: {
      speed_kmh: (most.column + 0.5) * speed_step_kmh,
      gain: (most.row + 0.5) * gain_step,
    },
  }
}

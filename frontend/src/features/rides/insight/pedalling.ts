// Where the cells of the gain stand in their picture.
import type { RidePedalling } from '$shared/api/types'

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

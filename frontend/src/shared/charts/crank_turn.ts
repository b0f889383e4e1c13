// Torque round the crank as a line over one turn.

export const WIDE = 360
export const TALL = 100
export const ROUND_DEG = 360

/** The greatest of all, for one scale from zero. */
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

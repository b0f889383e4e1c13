// A small line without axes: where it runs, and where it breaks because the value is unknown.

export const [SPARK_WIDTH, SPARK_HEIGHT] = [200, 40]

/** The line of values over times as an SVG path, top down; a missing value breaks it. Times and
    values belong together; a single value between two gaps is a point of no width. */
export function sparkPath(
  times_s: readonly number[],
  values: readonly (number | null)[],
  top: number | null,
): string {
  const [from, to] = [times_s[0] ?? 0, times_s.at(-1) ?? 0]
  const x = (time: number) => (SPARK_WIDTH * (time - from)) / (to - from || 1)
  const y = (value: number) => SPARK_HEIGHT - 1 - ((SPARK_HEIGHT - 2) * value) / (top || 1)
  let drawing = false
  return times_s
    .map((time, i) => {
      const value = values[i]
      if (value === null || value === undefined || !Number.isFinite(value)) {
        drawing = false
        return ''
      }
      const place = `${drawing ? 'L' : 'M'}${x(time).toFixed(1)} ${y(value).toFixed(1)}`
      const alone = drawing ? '' : 'h0'
      drawing = true
      return place + alone
    })
    .join('')
}

/** The largest of the values; null where there is none. */
export function topOf(...lines: (readonly (number | null)[])[]): number | null {
  const finite = lines.flat().filter((value) => value !== null && Number.isFinite(value))
  return finite.length > 0 ? Math.max(...(finite as number[])) : null
}

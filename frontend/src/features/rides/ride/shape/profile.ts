// One channel of the whole ride as a filled outline, for the brush and in the place of a map.
import type { Series } from '$shared/api/series'

export interface Outline {
  /** SVG paths; none over a gap. */
  paths: string[]
  least: number
  greatest: number
}

/** The greatest value of each bin over a floor, in a drawing of this size; null without values.
    at: 0 to 1, where a place of the series' axis lies. */
export function outline(
  series: Series,
  at: (x: number) => number,
  width: number,
  height: number,
): Outline | null {
  const [channel] = series.channels
  if (!channel) return null
  const valid = channel.max.filter((value) => !Number.isNaN(value))
  if (valid.length === 0) return null
  const greatest = valid.reduce((a, b) => Math.max(a, b))
  const least = channel.min
    .filter((value) => !Number.isNaN(value))
    .reduce((a, b) => Math.min(a, b))
  const first = series.x_first ?? series.t_first_s
  const last = series.x_last ?? series.t_last_s
  const y = (value: number) => height - ((value - least) / (greatest - least || 1)) * (height - 3)
  const runs: string[][] = [[]]
  for (let i = 0; i < first.length; i++) {
    const value = channel.max[i] ?? NaN
    if (Number.isNaN(value)) {
      runs.push([])
      continue
    }
    const [x0, x1] = [at(first[i] ?? 0) * width, at(last[i] ?? 0) * width]
    const top = y(value).toFixed(1)
    runs.at(-1)?.push(`${x0.toFixed(1)} ${top}`, `${x1.toFixed(1)} ${top}`)
  }
  const paths = runs
    .filter((run) => run.length > 0)
    .map((run) => {
      const left = run[0]?.split(' ')[0]
      const right = run.at(-1)?.split(' ')[0]
      return `M${left} ${height}L${run.join('L')}L${right} ${height}Z`
    })
  return { paths, least, greatest }
}

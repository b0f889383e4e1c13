// The figures of a calibration against what is allowed, as bars; all from the server's own.
import type { Figure } from '../words/words'
import type { Job } from '../job/types'

export type Piecewise = NonNullable<NonNullable<Job['worked']>['piecewise']>

/** A reading with the correction by pieces; beyond the outermost the last one holds. */
export function correctedNm({ reading_nm, correction_nm }: Piecewise, nm: number): number {
  const after = reading_nm.findIndex((one) => one >= nm)
  if (after <= 0) return nm + (correction_nm.at(after) ?? 0)
  const [low = nm, high = nm] = reading_nm.slice(after - 1)
  const [first = 0, last = 0] = correction_nm.slice(after - 1)
  return nm + first + ((nm - low) / (high - low)) * (last - first)
}

/** What the straight line leaves with the crank at its first planned angle: another one shows
    bending and how well the angle was met. */
export function straightResiduals(job: Job) {
  const states = new Map(job.captures.map(({ number, state }) => [number, state]))
  return (job.worked?.fit?.residuals ?? []).flatMap((one) => {
    const state = states.get(one.capture)
    const straight = state?.crank_angle_deg === job.setup?.angles_deg?.[0]
    return straight ? [{ ...one, down: state?.direction === 'unloading' }] : []
  })
}

export interface Bar {
  figure: Figure
  pct: number | null
  allowed_pct: number
}

/** In per cent of the full scale, the worse pedal of the two. */
export function barsOf(job: Job): Bar[] {
  const { worked, setup } = job
  if (!worked?.fit || !setup) return []
  const limits = worked.judgement.limits
  const full_nm = setup.full_scale_nm
  const share = (nm: number | null) => (nm === null ? null : (100 * Math.abs(nm)) / full_nm)
  const worse = (figures: number[]) => (figures.length > 0 ? Math.max(...figures) : null)
  const line = worse(worked.figures.map((side) => side.linearity_line_pct))
  const loop = worse(worked.figures.map((side) => side.hysteresis_pct))
  const total = worse(worked.figures.map((side) => side.total_deviation_pct))
  return [
    { figure: 'linearity_line', pct: line, allowed_pct: limits.linearity_pct },
    { figure: 'hysteresis', pct: loop, allowed_pct: limits.hysteresis_pct },
    {
      figure: 'repeatability',
      pct: share(2 * worked.fit.repeatability_nm),
      allowed_pct: limits.repeatability_pct,
    },
    {
      figure: 'zero_return',
      pct: share(worked.zero_return_nm),
      allowed_pct: limits.zero_return_pct,
    },
    { figure: 'total', pct: total, allowed_pct: limits.total_pct },
    {
      figure: 'expanded',
      pct: share(worked.budget ? Math.max(...worked.budget.expanded_nm) : null),
      allowed_pct: limits.expanded_pct,
    },
  ]
}

/** Standard uncertainties at the full scale, the largest first. */
export function sharesOf(job: Job): { figure: Figure; standard_nm: number }[] {
  const contributions = (job.worked?.budget?.contributions ?? []).map((one) => ({
    figure: one.cause as Figure,
    standard_nm: one.standard_nm.at(-1) ?? 0,
  }))
  return contributions.sort((one, other) => other.standard_nm - one.standard_nm)
}

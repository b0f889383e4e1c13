// Where a calibration stands in its six steps, and what is to be done next.
import type { Job, Step } from './types'

export const STEPS = ['checks', 'zero', 'weights', 'fit', 'write', 'verify'] as const
export type StepName = (typeof STEPS)[number]

/** The step that a job waits at. */
export function stepOf(job: Job): StepName {
  if (job.state === 'written' || job.state === 'verified' || job.state === 'closed') return 'verify'
  if (job.state === 'fitted') return 'write'
  if (job.setup === null) return 'checks'
  if (job.next_step === null) return 'fit'
  return job.next_step === 0 ? 'zero' : 'weights'
}

/** How many readings of the plan are not there yet. */
export function missingReadings(job: Job): number {
  return job.steps.filter((step) => step.capture === null).length
}

/** The newest reading that counts; of verifications alone once the fit is written. */
export function newest(job: Job) {
  const verifying = stepOf(job) === 'verify'
  return job.captures
    .filter((one) => one.struck === null && (one.state.kind === 'verify') === verifying)
    .at(-1)
}

/** Readings of one pedal: a line for each load, a column for each stroke and direction. */
export interface Grid {
  columns: { stroke: number; direction: 'loading' | 'unloading' }[]
  rows: { mass_kg: number; load_nm: number; cells: (number | null)[] }[]
  /** Steps at other angles than the first, which have no place in the grid. */
  angled: number[]
}

/** The plan of one side; a cell is the index of its step. */
export function gridOf(steps: readonly Step[], side: string): Grid {
  const level = steps[0]?.state.crank_angle_deg
  const own = steps.map((step, place) => ({ step, place })).filter((one) => isOf(one.step, side))
  const straight = own.filter(({ step }) => step.state.crank_angle_deg === level)
  const strokes = [...new Set(straight.map(({ step }) => step.state.stroke))]
  const columns = strokes.flatMap((stroke) =>
    (['loading', 'unloading'] as const).map((direction) => ({ stroke, direction })),
  )
  const masses = [...new Set(straight.map(({ step }) => step.state.mass_kg))]
  const rows = masses.map((mass_kg) => ({
    mass_kg,
    load_nm: straight.find(({ step }) => step.state.mass_kg === mass_kg)?.step.load_nm ?? 0,
    cells: columns.map(
      ({ stroke, direction }) =>
        straight.find(
          ({ step: { state } }) =>
            state.mass_kg === mass_kg && state.stroke === stroke && state.direction === direction,
        )?.place ?? null,
    ),
  }))
  const angled = own
    .filter(({ step }) => step.state.crank_angle_deg !== level)
    .map(({ place }) => place)
  return { columns, rows, angled }
}

const isOf = (step: Step, side: string) => step.state.side === side

/** The readings from one on to the end of its stroke, as they were taken: a load that is come to
    otherwise than before reads otherwise. */
export function restOfStroke(job: Job, number: number): number[] {
  const first = job.captures.find((one) => one.number === number)
  if (!first) return []
  return job.captures
    .filter(
      ({ number: n, state, struck }) =>
        struck === null &&
        n >= number &&
        state.kind !== 'verify' &&
        state.side === first.state.side &&
        state.stroke === first.state.stroke &&
        state.crank_angle_deg === first.state.crank_angle_deg,
    )
    .map((one) => one.number)
}

// What of a unit's history belongs onto the sheet of a job.
import type { ParameterValue, Revision, Ride } from '$shared/api/types'
import type { VisitFault } from '$shared/api/visit_server'

/** What was worked on: the faults seen meanwhile, and since when. */
export interface Work {
  faults: readonly VisitFault[]
  begun_at: string
}

export interface LastChange {
  old: ParameterValue | null
  new: ParameterValue | null
  at: string
}

/** The newest change of a parameter; null where the history has none. revisions: newest first. */
export function lastChange(revisions: readonly Revision[], name: string): LastChange | null {
  for (const { changed, created_at } of revisions) {
    const change = changed.find((one) => one.name === name)
    if (change) return { old: change.old ?? null, new: change.new ?? null, at: created_at }
  }
  return null
}

/** When the work on a unit was last seen to be done: the newest settings, the newest fault that was
    over; without either when the sheet was begun. */
export function workedAt(work: Work, revisions: readonly Revision[]): string {
  // One that was over when it was first seen has no time.
  const gone = work.faults.filter(({ seen_at, over_at }) => over_at !== seen_at)
  const over = gone.flatMap(({ over_at }) => over_at ?? [])
  const done = [...over, ...revisions.slice(0, 1).map(({ created_at }) => created_at)]
  const times = (done.length > 0 ? done : [work.begun_at]).map((at) => Date.parse(at))
  return new Date(Math.max(...times)).toISOString()
}

/** The ride if it is over and began after the work. */
export function rideAfter(
  ride: Ride | null,
  work: Work,
  revisions: readonly Revision[],
): Ride | null {
  if (ride?.state !== 'done') return null
  return Date.parse(ride.started_at) > Date.parse(workedAt(work, revisions)) ? ride : null
}

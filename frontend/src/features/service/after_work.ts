// When the work of a visit was done.
import type { VisitContent } from '$shared/api/visit_server'

/** When the bike was last seen to be worked on: a setting, a calibration, a fault that was over;
    without any when the visit began. */
export function workedAt(content: VisitContent, opened_at: string): string {
  // One that was over when it was first seen has no time.
  const gone = content.faults.filter(({ seen_at, over_at }) => over_at !== seen_at)
  const done = [
    ...gone.flatMap(({ over_at }) => over_at ?? []),
    ...content.changes.map(({ changed_at }) => changed_at),
    ...content.calibrations.map(({ closed_at }) => closed_at),
  ]
  const times = (done.length > 0 ? done : [opened_at]).map((at) => Date.parse(at))
  return new Date(Math.max(...times)).toISOString()
}

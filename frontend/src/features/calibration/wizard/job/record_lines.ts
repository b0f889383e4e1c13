// The unit's record as a change of it makes it: current against planned values.
import type { Job, RecordLine } from './types'

export type ChangeKind = Job['changes'][number]['kind']

/** `write`: as found against the fit. `restore`: written against what was before. */
export function recordLines(job: Job, kind: ChangeKind): RecordLine[] {
  const last = job.changes.at(-1)
  if (kind === 'write' || !last) return job.record
  return job.record.map((line) => {
    const planned = last.before[line.name] ?? null
    const { free_min, free_max } = line
    const beyond =
      typeof planned === 'number' &&
      free_min !== null &&
      free_max !== null &&
      (planned < free_min || planned > free_max)
    return { ...line, found: last.record[line.name] ?? null, planned, beyond }
  })
}

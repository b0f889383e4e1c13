// The job sheet of a unit, stored in this browser as it is typed, with the faults that were seen
// while it was open.
import type { Fault } from '$shared/api/types'

export const JOB_FIELDS = ['job', 'technician', 'owner', 'counter', 'complaint', 'done'] as const
export type JobField = (typeof JOB_FIELDS)[number]
export type JobValues = Record<JobField, string>

/** A fault the unit had while the sheet was open. over_at: when it was first seen to be over. */
export interface SeenFault {
  name: string
  count: number | null
  seen_at: string
  over_at: string | null
}

export interface Job {
  values: JobValues
  faults: SeenFault[]
  begun_at: string
}

const keyOf = (unit: string) => `spindle.job.${unit}`

/** An empty sheet that begins now. */
export function newJob(): Job {
  const values = Object.fromEntries(JOB_FIELDS.map((field) => [field, ''])) as JobValues
  return { values, faults: [], begun_at: new Date().toISOString() }
}

/** What was typed and seen for a unit; a new sheet where nothing was, or nothing can be stored. */
export function storedJob(unit: string): Job {
  const empty = newJob()
  try {
    const stored = JSON.parse(localStorage.getItem(keyOf(unit)) ?? '{}') as Partial<Job & JobValues>
    // An older sheet has its fields at the top.
    const texts = stored.values ?? stored
    const values = JOB_FIELDS.map((field) => [field, String(texts[field] ?? '')] as const)
    return {
      values: Object.fromEntries(values) as JobValues,
      faults: stored.faults ?? [],
      begun_at: stored.begun_at ?? empty.begun_at,
    }
  } catch {
    return empty
  }
}

export function storeJob(unit: string, job: Job): void {
  try {
    localStorage.setItem(keyOf(unit), JSON.stringify(job))
  } catch {
    // Nothing can be stored here: it lasts as long as the page.
  }
}

/** The faults of a sheet after the unit has reported its present ones. One that comes again is
    there again; one that is only remembered by the unit is on the sheet too, as over. */
export function seenFaults(before: SeenFault[], current: Fault[], now: string): SeenFault[] {
  const updated = before.map((seen) => {
    const fault = current.find((one) => one.name === seen.name)
    if (fault?.active) return { ...seen, count: fault.count, over_at: null }
    return { ...seen, over_at: seen.over_at ?? now }
  })
  const fresh = current.filter(({ name }) => !before.some((seen) => seen.name === name))
  return [
    ...updated,
    ...fresh.map(({ name, count, active }) => ({
      name,
      count,
      seen_at: now,
      over_at: active ? null : now,
    })),
  ]
}

// The job sheet of a unit, kept in this browser as it is typed.
export const JOB_FIELDS = ['job', 'technician', 'owner', 'counter', 'complaint', 'done'] as const
export type JobField = (typeof JOB_FIELDS)[number]
export type JobValues = Record<JobField, string>

const EMPTY: JobValues = {
  job: '',
  technician: '',
  owner: '',
  counter: '',
  complaint: '',
  done: '',
}
const keyOf = (unit: string) => `spindle.job.${unit}`

/** What was typed for a unit; empty where nothing was, or nothing can be kept. */
export function keptJob(unit: string): JobValues {
  try {
    const kept = JSON.parse(localStorage.getItem(keyOf(unit)) ?? '{}') as Partial<JobValues>
    const texts = JOB_FIELDS.map((field) => [field, String(kept[field] ?? '')] as const)
    return Object.fromEntries(texts) as JobValues
  } catch {
    return { ...EMPTY }
  }
}

export function keepJob(unit: string, values: JobValues): void {
  try {
    localStorage.setItem(keyOf(unit), JSON.stringify(values))
  } catch {
    // Nothing can be kept here: it lasts as long as the page.
  }
}

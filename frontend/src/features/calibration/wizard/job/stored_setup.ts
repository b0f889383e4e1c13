// Instruments and plan as they are typed, remembered on this workstation.
import type { Job, SetupRequest } from './types'

const KEY = 'spindle.calibration.setup'

/** What four discs of ten kilograms and a bathroom's care can do: a plan to begin with. */
export const FIRST: SetupRequest = {
  arm_m: 0.17,
  arm_limit_m: 0.0005,
  // Half of what gravity differs by from the equator to the poles: true wherever this is.
  gravity: { gravity_ms2: 9.807, standard_ms2: 0.015 },
  masses: [
    { name: '10 kg', mass_kg: 10, mass_class: null, limit_kg: 0.01 },
    { name: '5 kg', mass_kg: 5, mass_class: null, limit_kg: 0.005 },
  ],
  loads_kg: [10, 20, 30, 40],
  full_scale_nm: 80,
  strokes: 2,
  sides: ['right', 'left'],
  angles_deg: [0],
  level_limit_deg: 2,
  resolution_counts: 1,
  thermometer_limit_k: 0.5,
  zero_limit_nm_per_k: 0.02,
  span_limit_share_per_k: 0.0002,
}

/** The setup that a job begins with: its own, this workstation's last, another's here, or the
    first. */
export function setupOf(job: Job): SetupRequest {
  const own = job.setup ?? null
  return requestOf(own) ?? stored() ?? requestOf(job.suggested_setup) ?? structuredClone(FIRST)
}

export function storeSetup(setup: SetupRequest): void {
  write(KEY, setup)
}

/** What is typed of a job and not yet sent. plan: the job's own, when it was typed. */
export interface Typed {
  setup: SetupRequest
  reason: string
  plan: string
}

/** Stored until the job has it, or the job is closed. */
export function storeTyped(job: Job, setup: SetupRequest, reason: string): void {
  const same = JSON.stringify(setup) === JSON.stringify(setupOf(job))
  const over = job.closed_at !== null || (same && reason === '')
  const typed: Typed = { setup, reason, plan: planOf(job) }
  write(typedKey(job), over ? null : typed)
}

/** Null for none, and for a plan that was changed elsewhere meanwhile. */
export function typedOf(job: Job): Typed | null {
  const typed = read<Typed>(typedKey(job))
  return typed?.plan === planOf(job) && typed.setup ? (typed as Typed) : null
}

const typedKey = (job: Job) => `spindle.calibration.typed.${job.unit_key}.${job.id}`
const planOf = (job: Job) => JSON.stringify(job.setup ?? null)

function stored(): SetupRequest | null {
  const stored_setup = read<SetupRequest>(KEY)
  return stored_setup && { ...structuredClone(FIRST), ...stored_setup }
}

/** Null for nothing, and for what cannot be read. */
function read<T>(key: string): Partial<T> | null {
  try {
    return JSON.parse(localStorage.getItem(key) ?? 'null') as Partial<T> | null
  } catch {
    return null
  }
}

/** Null forgets it. Where nothing can be stored it lasts as long as the page. */
function write(key: string, value: object | null): void {
  try {
    if (value) localStorage.setItem(key, JSON.stringify(value))
    else localStorage.removeItem(key)
  } catch {
    // The next calibration suggests a plan all the same.
  }
}

/** A setup of the API as the request for it. */
function requestOf(setup: Job['setup']): SetupRequest | null {
  if (!setup) return null
  const { gravity, gain_nm_per_count, ...rest } = setup
  void gain_nm_per_count // set by the unit
  const { latitude_deg, height_m, gravity_ms2, standard_ms2 } = gravity
  const place = latitude_deg != null && height_m != null
  return {
    ...rest,
    gravity: place
      ? { latitude_deg, height_m, height_standard_m: 50 }
      : { gravity_ms2, standard_ms2 },
  } as SetupRequest
}

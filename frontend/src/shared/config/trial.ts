// A configuration on trial: what is seen of it, and what became of it once it is no longer there.
import type { Device, Revision } from '../api/types'

export interface Trial {
  device_id: string
  unit_key: string | null
  generation: number
  crc32: number
  ends_ms: number
}

/** kept: it is for good. Else the unit is back at what it had, and why: as requested, its time ran
    out, it was restarted or lost power, or it reports none. */
export type TrialEnd = 'kept' | 'asked' | 'time_out' | 'restart' | 'unknown'

/** The trial that runs in a unit now; null without one. The end is counted from the time left, so
    that a reader's clock need not agree with the server's. */
export function trialOf(device: Device | null, now_ms: number): Trial | null {
  const config = device?.config
  if (!device || config?.state !== 'provisional' || config.remaining_s === null) return null
  const { generation, crc32, remaining_s } = config
  const { id: device_id, unit_key } = device
  return { device_id, unit_key, generation, crc32, ends_ms: now_ms + remaining_s * 1000 }
}

/** Whether a unit answers, no longer has this trial, and has reported why. */
export function isOver(trial: Trial, device: Device | null): boolean {
  if (!device || device.unit_key !== trial.unit_key || device.state !== 'ready') return false
  if (device.config?.state !== 'committed') return false
  return device.config.crc32 === trial.crc32 || device.config.rollback_cause !== null
}

/** What became of a trial, by the unit's own word. */
export function endOf(trial: Trial, device: Device): TrialEnd {
  if (device.config?.crc32 === trial.crc32) return 'kept'
  return device.config?.rollback_cause ?? 'unknown'
}

/** What was written on trial; null when this Spindle did not write it. */
export function revisionOf(trial: Trial, revisions: readonly Revision[]): Revision | null {
  return revisions.find((r) => r.state === 'provisional' && r.crc32 === trial.crc32) ?? null
}

/** Whole seconds left, never less than 0. */
export function secondsLeft(trial: Trial, now_ms: number): number {
  return Math.max(0, Math.ceil((trial.ends_ms - now_ms) / 1000))
}

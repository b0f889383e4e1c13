// A configuration on trial: what is seen of it, and what became of it once it is no longer there.
import type { Device, Revision } from './types'

export interface Trial {
  device_id: string
  generation: number
  crc32: number
  ends_ms: number
}

/** kept: it is for good. Else the unit is back at what it had, and why. */
export type TrialEnd = 'kept' | 'reverted' | 'expired' | 'restarted'

const CLOCKS_DIFFER_MS = 1500 // the state is asked once a second, and both ends round

/** The trial that runs in a unit now; null without one. */
export function trialOf(device: Device | null): Trial | null {
  const config = device?.config
  if (!device || config?.state !== 'provisional' || !config.expires_at) return null
  const { generation, crc32 } = config
  return { device_id: device.id, generation, crc32, ends_ms: Date.parse(config.expires_at) }
}

/** Whether a unit answers and no longer has this trial. */
export function isOver(trial: Trial, device: Device | null): boolean {
  if (!device || device.id !== trial.device_id || device.state !== 'ready') return false
  return device.config?.state === 'committed'
}

/** What became of a trial. revisions: newest first; a return that was asked for is one of them. */
export function endOf(
  trial: Trial,
  device: Device,
  revisions: readonly Revision[],
  now_ms: number,
): TrialEnd {
  const crc32 = device.config?.crc32
  if (crc32 === trial.crc32) return 'kept'
  const newest = revisions[0]
  const asked = newest?.crc32 === crc32 && newest?.state !== 'provisional'
  if (asked && revisions[1]?.crc32 === trial.crc32) return 'reverted'
  return now_ms >= trial.ends_ms - CLOCKS_DIFFER_MS ? 'expired' : 'restarted'
}

/** What was written on trial; null when this Spindle did not write it. */
export function revisionOf(trial: Trial, revisions: readonly Revision[]): Revision | null {
  return revisions.find((r) => r.state === 'provisional' && r.crc32 === trial.crc32) ?? null
}

/** Whole seconds left, never less than 0. */
export function secondsLeft(trial: Trial, now_ms: number): number {
  return Math.max(0, Math.ceil((trial.ends_ms - now_ms) / 1000))
}

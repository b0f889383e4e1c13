// Words for faults: their names, what the rider reads, how they end, and how many there are.
import { FAULTS, type FaultRow } from '$generated/registry'
import type { Device } from '../api/types'
import type { Locale } from '../i18n/locale.svelte'

export type Severity = FaultRow['severity']

const rows: Readonly<Record<string, FaultRow>> = FAULTS

/** Whether this Spindle has words for a fault; a newer firmware has faults it has none for. */
export function isRecognised(name: string): boolean {
  return name in rows
}

/** How a fault ends; one of a newer firmware counts as latched, as the server has it. */
export function severityOf(name: string): Severity {
  return rows[name]?.severity ?? 'latched'
}

/** What a fault is called. */
export function faultLabel(locale: Locale, name: string): string {
  return locale.lookup(`fault_flag.${name}`, '') || locale.t('faults.newer', { name })
}

/** Several faults in one line. */
export function faultList(locale: Locale, names: readonly string[]): string {
  const between = locale.language === 'zh' ? '、' : ', '
  return names.map((name) => faultLabel(locale, name)).join(between)
}

/** What to do, in a rider's words. */
export function riderText(locale: Locale, name: string): string {
  const row = rows[name]
  return row ? locale.translated('fault', name, row.rider_text) : locale.t('faults.newer_text')
}

/** bad: the motor gives nothing. warn: warnings only. null: no fault. */
export function faultTone(device: Device | null): 'bad' | 'warn' | null {
  const names = device?.faults_active ?? []
  if (names.length === 0) return null
  return names.every((name) => severityOf(name) === 'warning') ? 'warn' : 'bad'
}

/** "1 fault", "2 faults", or of warnings alone "1 warning". */
export function faultCount(locale: Locale, device: Device): string {
  const count = device.faults_active.length
  const only_warnings = faultTone(device) === 'warn'
  if (count === 1) return locale.t(only_warnings ? 'faults.warning_one' : 'faults.one')
  return locale.t(only_warnings ? 'faults.warning_many' : 'faults.many', { count })
}

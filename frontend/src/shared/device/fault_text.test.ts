/* Goal: every fault has words and a way to end, one of a newer firmware too, and a fault that takes
   the assist is never shown as a mere warning. */
import { FAULTS, type FaultRow } from '$generated/registry'
import { expect, it, onTestFinished } from 'vitest'
import type { Device } from '../api/types'
import { Locale } from '../i18n/locale.svelte'
import { faultCount, faultLabel, faultTone, riderText, severityOf } from './fault_text'

const locale = new Locale()
const unit = (...faults_active: string[]) => ({ faults_active }) as Partial<Device> as Device

it('has words for every fault of the registry', () => {
  for (const name of Object.keys(FAULTS)) {
    expect(faultLabel(locale, name)).not.toContain(name)
    expect(riderText(locale, name).length).toBeGreaterThan(10)
  }
})

it('takes a fault it does not know for one that stays, and says that the firmware is newer', () => {
  expect(severityOf('fault_29')).toBe('latched')
  expect(faultLabel(locale, 'fault_29')).toContain('fault_29')
  expect(riderText(locale, 'fault_29')).toContain('firmware is newer')
  expect(faultTone(unit('fault_29'))).toBe('bad')
})

it('counts warnings as warnings only while there is nothing worse', () => {
  // No fault of today's units is a mere warning; one of tomorrow's may be.
  const rows = FAULTS as Record<string, FaultRow>
  rows.minor = { severity: 'warning', rider_text: '', mechanic_text: '' }
  onTestFinished(() => {
    delete rows.minor
  })

  expect([faultTone(null), faultTone(unit())]).toEqual([null, null])
  expect(faultTone(unit('minor'))).toBe('warn')
  expect(faultCount(locale, unit('minor'))).toBe('1 warning')
  expect(faultTone(unit('minor', 'battery_low'))).toBe('bad')
  expect(faultCount(locale, unit('minor', 'battery_low'))).toBe('2 faults')
})

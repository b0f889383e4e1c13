/* Goal: each check stands on the sheet with what was found, also where it could not be done. */
import type { UnitCheck } from '$shared/api/workbench_server'
import type { Units } from '$shared/units/units.svelte'
import { expect, it } from 'vitest'
import en from '$messages/en/service.json'
import { checkText, undone } from './checks'

const units = {
  text: (value: number, unit: string, digits = 1) => `${value.toFixed(digits)} ${unit}`,
} as unknown as Units
const say = (key: keyof typeof en, values: Record<string, unknown> = {}) =>
  Object.entries(values).reduce(
    (text, [name, value]) => text.replace(`{${name}}`, String(value)),
    en[key] as string,
  )
const EMPTY = { value: null, unit: null, limit: null, not_done: null, fault: null, evidence: null }
const text = (check: Partial<UnitCheck> & Pick<UnitCheck, 'name' | 'passed'>) =>
  checkText({ ...EMPTY, ...check }, say, units, (iso) => iso)
const NM = { unit: 'Nm', limit: 3 }
const RIDES = { started_at: 'Monday', rides: 2, per_month_nm: null, level: 'ok' }

it('names a reading and its limit', () => {
  expect(text({ name: 'zero', passed: true, value: 0.5, ...NM })).toEqual({
    word: 'check_zero',
    result: '0.5 Nm',
    allowed: '≤ 3 Nm',
    passed: true,
  })
  const battery = text({ name: 'battery', passed: true, value: 36.9, unit: 'V', limit: 31 })
  expect(battery.allowed).toBe('≥ 31.0 V')
})

it('names the newest zero with its ride, its trend, and that it has moved', () => {
  const check = { name: 'drift', passed: true, value: 0.42, ...NM } as const
  expect(text({ ...check, evidence: RIDES }).result).toBe('0.42 Nm, Monday; of 2 rides')
  const moved = text({ ...check, evidence: { ...RIDES, per_month_nm: 0.2, level: 'watch' } })
  expect(moved.result).toBe('0.42 Nm, Monday; of 2 rides; 0.20 Nm a month; watch it')
})

it('says why one was not done, and of a faulty sensor that it reads nothing', () => {
  expect(text({ name: 'zero', passed: null, not_done: 'not_sent' }).result).toBe(en.why_unsent)
  const moving = text({ name: 'zero', passed: null, value: 9, ...NM, not_done: 'moving' })
  expect(moving.result).toBe(en.why_moving)
  expect(text({ name: 'drift', passed: null, not_done: 'no_ride_shows_it' }).result).toBe(
    en.drift_none,
  )
  const dead = text({ name: 'zero', passed: false, ...NM, fault: 'torque_sensor' })
  expect([dead.result, dead.passed]).toEqual([en.no_reading, false])
})

it('counts erases and lost frames', () => {
  const seen = { erases: 12, damaged: false, runs_on_default: false }
  const flash = text({ name: 'flash', passed: true, evidence: seen })
  expect(flash.result).toBe('both places whole, 12 erases')
  const line = text({ name: 'line', passed: false, evidence: { built: 900, lost: 3 } })
  expect([line.result, line.allowed]).toEqual(['3 of 900 lost', en.none_lost])
})

it('has the same rows before anything was looked at', () => {
  expect(undone('wait').map(({ word }) => word)).toContain('check_flash')
})

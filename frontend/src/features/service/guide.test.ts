// @vitest-environment happy-dom
/* Goal: the guide covers every fault, and a live
   value speaks for or against a cause by the limit that the unit itself uses. */
import { FAULTS, CHANNELS } from '$generated/registry'
import { expect, it } from 'vitest'
import { CAUSES, causesOf, PROOFS, type Cause } from './guide'
import names_en from '$messages/en/service.json'
import steps_en from '$messages/en/guide.json'
import names_zh from '$messages/zh/service.json'
import steps_zh from '$messages/zh/guide.json'

const [en, zh] = [
  { ...names_en, ...steps_en },
  { ...names_zh, ...steps_zh },
]

it('has steps for every fault of the registry, each cause once', () => {
  for (const fault of Object.keys(FAULTS)) {
    const causes = causesOf(fault)
    expect(causes.length, fault).toBeGreaterThan(0)
    expect(new Set(causes).size, fault).toBe(causes.length)
  }
  expect(causesOf('fault_29')).toEqual([])
})

it('has a name, a question and a remedy for every cause, in both languages', () => {
  const used = new Set(Object.values(CAUSES).flat())
  expect([...used].sort()).toEqual((Object.keys(PROOFS) as Cause[]).sort())
  for (const cause of used) {
    for (const part of ['is', 'check', 'do'] as const) {
      expect(en[`${cause}.${part}`].length, cause).toBeGreaterThan(3)
      expect(zh[`${cause}.${part}`].length, cause).toBeGreaterThan(1)
    }
    expect(en[`${cause}.check`]).toMatch(/\?$/)
    expect(zh[`${cause}.check`]).toMatch(/？$/)
  }
})

it('reads only channels that a unit sends', () => {
  for (const proof of Object.values(PROOFS)) {
    if (proof) expect(Object.keys(CHANNELS)).toContain(proof.channel)
  }
})

it('takes a reading at the end of its range, or none, for a broken plug', () => {
  const points = (value: number | null) => PROOFS.spindle_plug?.points(value, null)

  expect([points(32767), points(-32767), points(null), points(1200)]).toEqual([
    true,
    true,
    true,
    false,
  ])
})

it('judges the voltage only where the least that is allowed is known', () => {
  const points = PROOFS.battery_contacts?.points

  expect(points?.(29, 30)).toBe(true)
  expect(points?.(36, 30)).toBe(false)
  expect(points?.(29, null)).toBeNull()
  expect(points?.(null, 30)).toBeNull()
})

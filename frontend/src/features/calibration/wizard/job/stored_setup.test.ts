/* Goal: what is typed of a calibration's plan is there again after a reload, for its own job
   alone. */
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest'
import { FIRST, storeTyped, typedOf } from './stored_setup'
import type { Job } from './types'

const job = (changes: Partial<Job> = {}): Job =>
  ({ id: 4, unit_key: 'ebl:11', setup: null, closed_at: null, ...changes }) as Job
const typed = { ...structuredClone(FIRST), arm_m: 0.1725 }

describe('a plan that is being typed', () => {
  beforeEach(() => {
    const storage = new Map<string, string>()
    vi.stubGlobal('localStorage', {
      getItem: (name: string) => storage.get(name) ?? null,
      setItem: (name: string, value: string) => storage.set(name, value),
      removeItem: (name: string) => storage.delete(name),
    })
  })
  afterEach(() => vi.unstubAllGlobals())

  it('is restored, with its reason', () => {
    storeTyped(job(), typed, 'new cranks')

    expect(typedOf(job())).toMatchObject({ setup: { arm_m: 0.1725 }, reason: 'new cranks' })
  })

  it.each([
    ['another job', job({ id: 5 })],
    ['another unit', job({ unit_key: 'ebl:22' })],
    ['a plan that was made meanwhile', job({ setup: { arm_m: 0.165 } as Job['setup'] })],
  ])('is not of %s', (_, other) => {
    storeTyped(job(), typed, '')

    expect(typedOf(other)).toBeNull()
  })

  it('goes with what it became, and with its job', () => {
    for (const end of [
      () => storeTyped(job(), structuredClone(FIRST), ''),
      () => storeTyped(job({ closed_at: '2026-11-27T08:00:00Z' }), typed, 'new cranks'),
    ]) {
      storeTyped(job(), typed, 'new cranks')
      end()
      expect(typedOf(job())).toBeNull()
    }
  })
})

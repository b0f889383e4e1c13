/* Goal: a server without accounts permits everything, a rider what their role does. */
import { expect, it } from 'vitest'
import { Permits } from './permits'

const rita = {
  id: 3,
  name: 'Rita',
  role: 'rider' as const,
  enabled: true,
  created_at: '2026-11-01T08:00:00Z',
  signed_in_at: null,
}

it('permits everything where nobody signs in', () => {
  const permits = new Permits()

  expect([permits.has('manage_people'), permits.own_only]).toEqual([true, false])
})

it('permits a rider their own rides and no unit', () => {
  const permits = new Permits()
  permits.take({ person: rita, permissions: ['see_rides', 'see_register'] })

  expect([permits.has('see_rides'), permits.has('see_bikes')]).toEqual([true, false])
  expect(permits.own_only).toBe(true)
})

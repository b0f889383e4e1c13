// @vitest-environment happy-dom
/* Goal: the sheet shows which faults there were before the work and what became of them. */
import type { Fault } from '$shared/api/types'
import { expect, it } from 'vitest'
import { storeJob, storedJob, seenFaults } from './job'

const fault = (name: string, active: boolean, count = 1) => {
  const fields: Partial<Fault> = { name, active, count }
  return fields as Fault
}
const [TEN, ELEVEN, NOON] = ['10:00', '11:00', '12:00']

it('notes a fault when it is first seen and when it is first seen to be over', () => {
  let seen = seenFaults([], [fault('torque_sensor', true), fault('battery_low', false)], TEN)
  expect(seen.map(({ name, over_at }) => [name, over_at])).toEqual([
    ['torque_sensor', null],
    ['battery_low', TEN],
  ])

  seen = seenFaults(seen, [], ELEVEN)
  seen = seenFaults(seen, [], NOON)
  expect(seen).toEqual([
    { name: 'torque_sensor', count: 1, seen_at: TEN, over_at: ELEVEN },
    { name: 'battery_low', count: 1, seen_at: TEN, over_at: TEN },
  ])
})

it('has a fault that comes again as there, since it was first seen', () => {
  const seen = seenFaults([], [fault('torque_sensor', true)], TEN)
  const gone = seenFaults(seen, [], ELEVEN)

  expect(seenFaults(gone, [fault('torque_sensor', true, 2)], NOON)).toEqual([
    { name: 'torque_sensor', count: 2, seen_at: TEN, over_at: null },
  ])
})

it('is kept for each unit, and takes what an older Spindle kept', () => {
  localStorage.setItem('spindle.job.one', JSON.stringify({ job: '0815', owner: 'owner 14' }))
  const job = storedJob('one')
  expect([job.values.job, job.values.owner, job.faults]).toEqual(['0815', 'owner 14', []])

  storeJob('one', { ...job, faults: seenFaults([], [fault('torque_sensor', true)], TEN) })
  expect(storedJob('one').faults[0]?.name).toBe('torque_sensor')
  expect(storedJob('two').values.job).toBe('')
})

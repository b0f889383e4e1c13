// @vitest-environment happy-dom
/* Goal: the sheet shows a ride only if it was made after the work, and a calibration only as the
   history has it. */
import type { Revision, Ride } from '$shared/api/types'
import { expect, it } from 'vitest'
import { lastChange, rideAfter, type Work } from './on_sheet'

const at = (hour: number) => new Date(Date.UTC(2026, 10, 22, hour)).toISOString()
const ride = (hour: number, state = 'done') => {
  const row: Partial<Ride> = { id: hour, state: state as Ride['state'], started_at: at(hour) }
  return row as Ride
}
const revision = (hour: number, changed: Revision['changed'] = []) => {
  const row: Partial<Revision> = { seq: hour, created_at: at(hour), changed }
  return row as Revision
}
const work = (...over: number[]): Work => ({
  begun_at: at(8),
  faults: over.map((hour) => ({ name: `${hour}`, count: 1, seen_at: at(8), over_at: at(hour) })),
})

it('takes a ride after the newest settings and the newest fault that was over', () => {
  expect(rideAfter(ride(14), work(), [revision(13), revision(9)])?.id).toBe(14)
  expect(rideAfter(ride(12), work(), [revision(13), revision(9)])).toBeNull()
  expect(rideAfter(ride(14), work(15, 10), [revision(13)])).toBeNull()
  // Over when it was first seen: its start is unknown.
  expect(rideAfter(ride(9), { ...work(8), begun_at: at(7) }, [])?.id).toBe(9)
})

it('takes one after the sheet was begun where nothing was done, and none that goes on', () => {
  expect(rideAfter(ride(9), work(), [])?.id).toBe(9)
  expect(rideAfter(ride(7), work(), [])).toBeNull()
  expect(rideAfter(ride(9, 'live'), work(), [])).toBeNull()
  expect(rideAfter(null, work(), [])).toBeNull()
})

it('shows the newest change of a parameter, and none where there was none', () => {
  const name = 'sensor_offset_counts'
  const history = [
    revision(12, [{ name: 'pedal_stop_ms', old: 1, new: 2 }]),
    revision(11, [{ name, old: 0, new: -3 }]),
    revision(10, [{ name, old: 5, new: 0 }]),
  ]

  expect(lastChange(history, name)).toEqual({ old: 0, new: -3, at: at(11) })
  expect(lastChange(history, 'sensor_gain_nm_per_count')).toBeNull()
})

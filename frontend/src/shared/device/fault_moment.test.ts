/* Goal: the picture of a fault shows each sample where it was, and a missing reading as missing. */
import { expect, it } from 'vitest'
import type { FaultMoment } from '../api/types'
import { figuresOf, momentPath, scaleOf, unread } from './fault_moment'

const at_s = [-2, -1, 0, 0.5, 1]

it('draws a line at its own time and height, and breaks it where nothing was read', () => {
  // 300 wide for 3 s, 60 high for 60 Nm.
  const path = momentPath(at_s, [0, 60, null, 30, 30], { low: 0, top: 60 })

  expect(path).toBe('M0.0 60.0L100.0 0.0M250.0 30.0L300.0 30.0')
})

it('names every stretch without a reading, and none where there is one', () => {
  expect(unread(at_s, [1, null, 1, null, null])).toEqual([
    [-1, 0],
    [0.5, 1],
  ])
  expect(unread(at_s, [1, 1, 1, 1, 0])).toEqual([])
})

it('keeps zero on the scale, and a backward push too', () => {
  expect(scaleOf([31, null])).toEqual({ low: 0, top: 40 })
  expect(scaleOf([-3], [4])).toEqual({ low: -10, top: 20 })
})

it('describes the push before, from when nothing was read, and what became of the motor', () => {
  const moment: Partial<FaultMoment> = {
    // The reading is gone before the unit is sure of the fault, and the motor with it.
    at_s: [-2, -1, -0.1, 0, 1],
    rider_torque_nm: [12, 40, null, null, null],
    motor_torque_nm: [30, 32, 0, 0, 0],
  }

  expect(figuresOf(moment as FaultMoment)).toEqual({
    rider_least: 12,
    rider_most: 40,
    unread_from_s: -0.1,
    motor_before: 32,
    motor_after: 0,
  })
})

it('claims no end of the readings while they go on', () => {
  const moment: Partial<FaultMoment> = {
    at_s,
    rider_torque_nm: [null, 40, null, 38, 37],
    motor_torque_nm: [null, null, null, null, null],
  }

  expect(figuresOf(moment as FaultMoment)).toMatchObject({
    unread_from_s: null,
    motor_before: null,
    motor_after: null,
  })
})

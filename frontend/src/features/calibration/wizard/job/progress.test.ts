/* Goal: the page stands at the step that the job waits at, and shows the plan as a table. Plans by
   hand. */
import { expect, it } from 'vitest'
import { gridOf, missingReadings, restOfStroke, stepOf } from './progress'
import type { Job, Step } from './types'

const step = (
  kind: 'zero' | 'load',
  mass_kg: number,
  direction: 'loading' | 'unloading',
  capture: number | null,
  crank_angle_deg = 0,
): Step => ({
  state: { kind, side: 'right', mass_kg, direction, stroke: 1, crank_angle_deg },
  load_nm: mass_kg,
  capture,
})
const plan = (done: number): Step[] =>
  [
    step('zero', 0, 'loading', 1),
    step('load', 10, 'loading', 2),
    step('load', 10, 'unloading', 3),
    step('zero', 0, 'unloading', 4),
    step('load', 10, 'loading', 5, 30),
  ].map((one, place) => ({ ...one, capture: place < done ? one.capture : null }))
const job = (done: number, more: Partial<Job> = {}) => {
  const steps = plan(done)
  const captures = steps.slice(0, done).map(({ state }, place) => ({
    number: place + 1,
    state,
    struck: null,
  }))
  const next_step = done < steps.length ? done : null
  const setup = { strokes: 1 }
  return { state: 'capturing', setup, steps, next_step, captures, ...more } as unknown as Job
}

it('stands at zero, at the weights and at the fit, as the plan is done', () => {
  expect(stepOf(job(0, { setup: null }))).toBe('checks')
  expect(stepOf(job(0))).toBe('zero')
  expect(stepOf(job(1))).toBe('weights')
  expect(stepOf(job(5))).toBe('fit')
  expect(stepOf(job(5, { state: 'fitted' }))).toBe('write')
  expect(stepOf(job(5, { state: 'written' }))).toBe('verify')
  expect(missingReadings(job(2))).toBe(3)
})

it('has a line for each load, a column for each way, and other angles apart', () => {
  const { columns, rows, angled } = gridOf(plan(0), 'right')

  expect(columns.map(({ direction }) => direction)).toEqual(['loading', 'unloading'])
  expect(rows.map(({ mass_kg, cells }) => [mass_kg, cells])).toEqual([
    [0, [0, 3]],
    [10, [1, 2]],
  ])
  expect(angled).toEqual([4])
  expect(gridOf(plan(0), 'left').rows).toEqual([])
})

it('repeats a stroke from a reading on, not what came at another angle', () => {
  expect(restOfStroke(job(5), 3)).toEqual([3, 4])
})

/* Goal: a page says "nothing was written" only where that is known. */
import { expect, it } from 'vitest'
import { Refusal } from '../api/client'
import { writeOutcome } from './write_outcome'

const outcome = (status: number, code: string) => writeOutcome(new Refusal(status, code, ''))

it('does not know what became of a change whose last answer is missing', () => {
  expect(outcome(504, 'commit_unanswered')).toBe('unknown')
  expect(outcome(504, 'no_result')).toBe('unknown')
  expect(outcome(504, 'no_answer')).toBe('unknown')
  expect(outcome(0, 'unreachable')).toBe('unknown')
  expect(outcome(500, 'error')).toBe('unknown')
})

it('believes the server where it read the unit again', () => {
  const outcomeOf = (outcome: Refusal['outcome']) =>
    writeOutcome(new Refusal(504, 'commit_unanswered', '', [], null, outcome))

  expect(outcomeOf('changed')).toBe('changed')
  expect(outcomeOf('unchanged')).toBe('silent')
  expect(outcomeOf('unknown')).toBe('unknown')
})

it('distinguishes a silent unit from one that refuses', () => {
  expect(outcome(503, 'not_connected')).toBe('silent')
  expect(outcome(422, 'out_of_range')).toBe('refused')
  expect(outcome(409, 'not_standing_still')).toBe('moving')
  expect(outcome(412, 'config_changed')).toBe('conflict')
})

it('never calls a change that reads back different unwritten', () => {
  expect(outcome(502, 'read_back_differs')).toBe('differs')
})

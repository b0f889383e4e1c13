/* Goal: who takes back a calibration sees what the unit gets, and whether that takes a token. A
   record by hand: the unit came with a gain beyond the band. */
import { expect, it } from 'vitest'
import { recordLines } from './record_lines'
import type { Job } from './types'

const GAIN = 'sensor_gain_nm_per_count'
const line = { name: GAIN, found: 0.013, planned: 0.0101, free_min: 0.0085, free_max: 0.0115 }
const job = (before: number) =>
  ({
    record: [{ ...line, beyond: false }],
    changes: [{ kind: 'write', record: { [GAIN]: 0.0101 }, before: { [GAIN]: before } }],
  }) as unknown as Job

it('restoring gives back what was there before the write', () => {
  const [found] = recordLines(job(0.011), 'restore')

  expect(found).toMatchObject({ found: 0.0101, planned: 0.011, beyond: false })
})

it('an old value beyond the band needs the maker’s token', () => {
  expect(recordLines(job(0.013), 'restore')[0]?.beyond).toBe(true)
  expect(recordLines(job(0.013), 'write')[0]?.beyond).toBe(false)
})

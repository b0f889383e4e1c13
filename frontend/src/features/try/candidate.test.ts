/* Goal: what is tried is the tables and modes that were chosen, and an address names them. */
import { PARAMETERS } from '$generated/registry'
import type { Server } from '$shared/api/server'
import type { FuzzyTable, Parameter, ParameterValue } from '$shared/api/types'
import { ConfigDraft } from '$shared/config/config_draft.svelte'
import { expect, it } from 'vitest'
import { candidateIn, libraryId, questionOf } from './candidate'

const five = <T>(value: T): T[] => Array(5).fill(value)
const first: Record<string, ParameterValue> = {
  fuzzy_table_name: 'dry',
  fuzzy_inference: 'weighted_average',
  fuzzy_speed_points_kmh: [5, 10, 15, 20, 25],
  fuzzy_torque_rate_points: [0, 0.2, 0.4, 0.6, 0.8],
  fuzzy_gain_points: [0.1, 0.2, 0.3, 0.4, 0.5],
  fuzzy_rules: five(five('ZO')),
}
const rest: Record<string, ParameterValue> = {
  second_table_name: 'wet',
  second_inference: 'weighted_average',
  second_gain_points: [0, 0.1, 0.2, 0.3, 0.4],
  second_rules: five(five('NB')),
  mode_names: five('sport'),
  mode_laws: five('fuzzy'),
  mode_ratios: five(1),
  mode_tapers: five('none'),
  mode_tables: [0, 0, 0, 0, 1],
  mode_ramp_up_nm_per_s: five(2000),
  mode_ramp_down_nm_per_s: five(2000),
  mode_torque_pct: five(100),
  assist_mode_at_start: 2,
}

async function draftOf(values: Record<string, ParameterValue>): Promise<ConfigDraft> {
  const rows = Object.entries(PARAMETERS).filter(([name]) => name in values)
  const server = {
    parameters: async () =>
      rows.map(([name, row]) => ({ ...row, name, choices: null }) as unknown as Parameter),
    config: async () => [{ parameters: values, generation: 1, crc32: 1 }, 'tag'],
  }
  const draft = new ConfigDraft('unit', server as unknown as Server)
  await draft.load()
  return draft
}

it('tries both tables and the modes, as they are edited or as the unit has them', async () => {
  const draft = await draftOf({ ...first, ...rest })
  draft.set('second_rules', five(five('PB')))

  const edited = questionOf('draft', draft, null)
  const held = questionOf('unit', draft, null)

  expect(edited?.fuzzy_table?.name).toBe('dry')
  expect(edited?.second_table?.rules).toEqual(five(five('PB')))
  expect(held?.second_table?.rules).toEqual(five(five('NB')))
  expect(edited?.assist_modes?.modes[4]?.table).toBe('second')
})

it('waits while an edited value is impossible, and still tries what the unit has', async () => {
  const draft = await draftOf({ ...first, ...rest })
  draft.set('second_gain_points', [0.4, 0.1, 0.2, 0.3, 0.4])

  expect(questionOf('draft', draft, null)).toBeNull()
  expect(questionOf('unit', draft, null)).not.toBeNull()
})

it('tries one table where the unit has one', async () => {
  const question = questionOf('draft', await draftOf(first), null)

  expect(question).toMatchObject({ second_table: null, assist_modes: null })
  expect(question?.fuzzy_table?.rules).toEqual(five(five('ZO')))
})

it('tries nothing new without a unit: the ride once more, or a table of the library', () => {
  const even = { name: 'even' } as FuzzyTable
  const unchanged = { fuzzy_table: null, second_table: null, assist_modes: null }

  expect(questionOf('ride', null, null)).toEqual({ mode: 'open_loop', ...unchanged })
  expect(questionOf('library:even', null, even)).toMatchObject({ ...unchanged, fuzzy_table: even })
  expect(questionOf('library:even', null, null)).toBeNull()
  expect(questionOf('draft', null, null)).toBeNull()
})

it.each([
  ['', 'draft'],
  ['with=unit', 'unit'],
  ['with=ride&ride=3', 'ride'],
  ['with=library:even', 'library:even'],
  ['with=nonsense', 'draft'],
])('the address %s names %s', (query, candidate) => {
  expect(candidateIn(new URLSearchParams(query))).toBe(candidate)
})

it('knows the tables of the library from the others', () => {
  expect([libraryId('library:even'), libraryId('draft')]).toEqual(['even', null])
})

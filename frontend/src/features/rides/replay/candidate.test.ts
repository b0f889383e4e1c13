/* Goal: what is tried is all the settings that were chosen, and an address names them. */
import { PARAMETERS } from '$generated/registry'
import type { Server } from '$shared/api/server'
import type { Parameter, ParameterValue } from '$shared/api/types'
import { ConfigDraft } from '$shared/config/config_draft.svelte'
import { expect, it } from 'vitest'
import { candidateIn, libraryId, massOf, settingsOf } from './candidate'

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
  const draft = new ConfigDraft({ id: 'unit', unit_key: null }, server as unknown as Server)
  await draft.load()
  return draft
}

it('tries all that is edited, or all that the unit has', async () => {
  const draft = await draftOf({ ...first, ...rest })
  draft.set('second_rules', five(five('PB')))

  expect(settingsOf('draft', draft, null)).toEqual({
    ...first,
    ...rest,
    second_rules: five(five('PB')),
  })
  expect(settingsOf('unit', draft, null)).toEqual({ ...first, ...rest })
})

it('tries a band and a filter that a proposal put into the draft', async () => {
  const draft = await draftOf({ ...first, assist_cutoff_band_kmh: 2, torque_filter_s: 0.5 })
  draft.set('assist_cutoff_band_kmh', 3.4)
  draft.set('torque_filter_s', 0.72)

  expect(settingsOf('draft', draft, null)).toMatchObject({
    assist_cutoff_band_kmh: 3.4,
    torque_filter_s: 0.72,
  })
})

it('waits while an edited value is impossible, and still tries what the unit has', async () => {
  const draft = await draftOf({ ...first, ...rest })
  draft.set('second_gain_points', [0.4, 0.1, 0.2, 0.3, 0.4])

  expect(settingsOf('draft', draft, null)).toBeNull()
  expect(settingsOf('unit', draft, null)).not.toBeNull()
})

it('tries nothing new without a unit: the ride once more, or an entry of the library', () => {
  const even = { fuzzy_table_name: 'even' }

  expect(settingsOf('ride', null, null)).toEqual({})
  expect(settingsOf('library:even', null, even)).toBe(even)
  expect(settingsOf('library:even', null, null)).toBeNull()
  expect(settingsOf('draft', null, null)).toBeNull()
})

it('takes a mass that a rider and a bike can have', () => {
  expect([null, 8, 85, 999].map(massOf)).toEqual([null, null, 85, null])
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

it('knows the entries of the library from the others', () => {
  expect([libraryId('library:even'), libraryId('draft')]).toEqual(['even', null])
})

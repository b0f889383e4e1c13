/* Goal: each table is edited by its own parameters, and is judged with the modes that use it. */
import { PARAMETERS } from '$generated/registry'
import { expect, it } from 'vitest'
import type { Server } from '../api/server'
import type { Parameter, ParameterValue } from '../api/types'
import { ConfigDraft } from './config_draft.svelte'
import {
  isChanged,
  modesWith,
  PARAMETERS_OF,
  surroundings,
  tableOf,
  tableOfMode,
  tableWith,
} from './two_tables'

const five = <T>(value: T): T[] => Array(5).fill(value)
const rules = five(five('ZO'))
const values: Record<string, ParameterValue> = {
  fuzzy_table_name: 'dry',
  fuzzy_inference: 'mamdani_centroid',
  fuzzy_speed_points_kmh: [5, 10, 15, 20, 25],
  fuzzy_torque_rate_points: [0, 0.2, 0.4, 0.6, 0.8],
  fuzzy_gain_points: [0.1, 0.2, 0.3, 0.4, 0.5],
  fuzzy_rules: rules,
  second_table_name: 'wet',
  second_inference: 'weighted_average',
  second_gain_points: [0, 0.1, 0.2, 0.3, 0.4],
  second_rules: rules,
  mode_names: ['off', 'eco', 'tour', 'sport', ''],
  mode_laws: ['off', 'fixed', 'fuzzy', 'fuzzy', 'fuzzy'],
  mode_ratios: five(1),
  mode_tapers: five('none'),
  mode_tables: [1, 1, 0, 1, 1],
  mode_ramp_up_nm_per_s: five(2000),
  mode_ramp_down_nm_per_s: five(2000),
  mode_torque_pct: five(100),
  assist_mode_at_start: 2,
  fixed_taper_start_kmh: 15,
  fixed_taper_end_kmh: 24,
  assist_cutoff_kmh: 25,
  market: 'japan',
  gear_ratio: 36.744,
}
const groups: Record<string, string> = {
  assist_cutoff_kmh: 'limits',
  market: 'market',
  gear_ratio: 'drivetrain',
}

function parameter(name: string): Parameter {
  const group = groups[name] ?? (/fuzzy|second/.test(name) ? 'fuzzy' : 'assist')
  const [min, max] = group === 'limits' ? [0, 25] : [null, null]
  const value = values[name] ?? 0
  return {
    id: 1,
    name,
    group,
    type: 'f32',
    shape: [],
    may_be_none: false,
    of_the_unit: false,
    length: null,
    unit: '',
    min,
    max,
    default: value,
    access: 'dealer',
    value,
    choices: null,
    free: null,
    description: '',
  }
}

async function draftOf(): Promise<ConfigDraft> {
  const server = {
    parameters: async () => Object.keys(values).map(parameter),
    config: async () => [{ generation: 1, crc32: 0, parameters: values }, '"1"'],
  }
  const draft = new ConfigDraft({ id: 'unit', unit_key: null }, server as unknown as Server)
  await draft.load()
  return draft
}

it('knows both tables by parameters the registry has', () => {
  const names = [...Object.values(PARAMETERS_OF.first), ...Object.values(PARAMETERS_OF.second)]

  expect(names.filter((name) => !(name in PARAMETERS))).toEqual([])
})

it('reads each table from its own parameters and the points both share', async () => {
  const draft = await draftOf()

  const [first, second] = [tableOf(draft, 'first'), tableOf(draft, 'second')]

  expect([first?.name, second?.name]).toEqual(['dry', 'wet'])
  expect(second?.inference).toBe('weighted_average')
  expect(second?.gain_points).toEqual([0, 0.1, 0.2, 0.3, 0.4])
  expect(second?.speed_points_kmh).toEqual(first?.speed_points_kmh)
})

it('names the modes that run by a table, and not those whose law has none', async () => {
  const draft = await draftOf()

  expect(modesWith(draft, 'first')).toEqual(['tour'])
  expect(modesWith(draft, 'second')).toEqual(['sport', '4'])
  expect(tableOfMode((name) => draft.base(name), 1)).toBeNull()
  expect(tableOfMode((name) => draft.base(name), -1)).toBeNull()
})

it('follows a mode that is given the other table before that is written', async () => {
  const draft = await draftOf()

  draft.set('mode_tables', [1, 1, 1, 0, 1])

  expect(modesWith(draft, 'first')).toEqual(['sport'])
  expect(modesWith(draft, 'second')).toEqual(['tour', '4'])
})

it('marks the table that was edited, both for none of its own', async () => {
  const draft = await draftOf()

  draft.set('second_rules', five(five('PB')))
  draft.set('fuzzy_speed_points_kmh', [5, 10, 15, 20, 24])

  expect([isChanged(draft, 'first'), isChanged(draft, 'second')]).toEqual([false, true])
})

it('keeps edits of both, and finds by the names that undo moved which table to show', async () => {
  const draft = await draftOf()
  draft.set('second_rules', five(five('PB')))
  draft.set('fuzzy_gain_points', [0.1, 0.2, 0.3, 0.4, 0.45])

  expect(draft.count).toBe(26)
  expect(tableWith(draft.undo())).toBe('first')
  expect(tableWith(draft.undo())).toBe('second')
  expect(tableWith(draft.redo())).toBe('second')
  expect(tableWith(['mode_tables', 'fuzzy_speed_points_kmh'])).toBeNull()
})

it('has a table judged with the modes, the market and the taper it would run with', async () => {
  const { assist_modes, limits, taper_speeds_kmh, gear_ratio } = surroundings(await draftOf())

  expect(assist_modes?.modes[3]).toEqual({
    name: 'sport',
    law: 'fuzzy',
    ratio: 1,
    taper: 'none',
    table: 'second',
    ramp_up_nm_per_s: 2000,
    ramp_down_nm_per_s: 2000,
    torque_pct: 100,
  })
  expect(limits).toEqual({ assist_cutoff_kmh: 25, market: 'japan' })
  expect(taper_speeds_kmh).toEqual([15, 24])
  expect(gear_ratio).toBe(36.744)
})

it('leaves out what cannot be written, instead of having it judged', async () => {
  const draft = await draftOf()

  draft.set('assist_cutoff_kmh', 26)
  draft.set('mode_ratios', [1, NaN, 1, 1, 1])

  expect(surroundings(draft)).toEqual({
    assist_modes: null,
    limits: null,
    taper_speeds_kmh: null,
    gear_ratio: 36.744,
  })
})

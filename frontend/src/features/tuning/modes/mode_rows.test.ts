/* Goal: a mode shows the settings its law has, and one is copied to the next mode that has it. */
import type { Server } from '$shared/api/server'
import { ConfigDraft } from '$shared/config/config_draft.svelte'
import { beforeEach, expect, it } from 'vitest'
import { cell, copyRight, hasSetting, isChangedAt, MODE_ROWS, type ModeRow } from './mode_rows'

const parameters = {
  mode_laws: ['off', 'fixed', 'fuzzy', 'fixed', 'fuzzy'],
  mode_ratios: [0, 0.5, 1, 1.2, 1.5],
  mode_tapers: ['none', 'none', 'none', 'none', 'none'],
}
const rows: ModeRow[] = MODE_ROWS.flatMap((group) => [...group.rows])
const row = (name: string) => rows.find((one) => one.name === name) as ModeRow
let draft: ConfigDraft

beforeEach(async () => {
  const server = {
    parameters: async () => Object.keys(parameters).map((name) => ({ name, group: 'assist' })),
    config: async () => [{ generation: 1, crc32: 2, parameters }, 'tag'],
  }
  draft = new ConfigDraft({ id: 'bench', unit_key: null }, server as unknown as Server)
  await draft.load()
})

it('shows the taper of the fixed law only and no ratio of a mode that is off', () => {
  const has = (name: string) => [0, 1, 2, 3, 4].map((slot) => hasSetting(draft, row(name), slot))

  expect(has('mode_tapers')).toEqual([false, true, false, true, false])
  expect(has('mode_ratios')).toEqual([false, true, true, true, true])
})

it('copies a setting to the next mode that has it, and that is one edit', () => {
  draft.set('mode_tapers', ['none', 'japan_1_to_1', 'none', 'none', 'none'])

  expect(copyRight(draft, row('mode_tapers'), 1)).toBe(3)

  expect(cell(draft, 'mode_tapers', 3)).toBe('japan_1_to_1')
  expect([2, 3].map((slot) => isChangedAt(draft, 'mode_tapers', slot))).toEqual([false, true])
  draft.undo()
  expect(isChangedAt(draft, 'mode_tapers', 3)).toBe(false)
})

it('copies nothing out of the last mode or out of one without the setting', () => {
  expect(copyRight(draft, row('mode_ratios'), 4)).toBeNull()
  expect(copyRight(draft, row('mode_ratios'), 0)).toBeNull()
  expect(draft.count).toBe(0)
})

// @vitest-environment happy-dom
/* Goal: the sentence and the waterfall show what the steps contain: what took how much, in the
   unit's order, and what was not delivered or not measured is called so. Both languages have the
   same words. */
import type { Why } from '$shared/api/types'
import { Locale } from '$shared/i18n/locale.svelte'
import { Units } from '$shared/units/units.svelte'
import { expect, it } from 'vitest'
import { gainShape } from './gain_shape'
import { demandedNm, rowValue, sentence, tableCannotHelp, takers, waterfall } from './steps'
import en from '$messages/en/why.json'
import { words, type Key } from './words'
import zh from '$messages/zh/why.json'

const locale = new Locale()
const units = new Units(locale, 'metric')
const say = words(locale)
const RAD_PER_S = 4.5

const step = (name: string, torque_nm: number) => ({
  name,
  torque_nm,
  power_w: torque_nm * RAD_PER_S,
  limit: null,
})

function why(changes: Partial<Why> = {}): Why {
  const steps = [
    step('rider_torque', 61.4),
    step('mode_ratio', 30.7),
    step('gain', 27.3),
    step('pedal_threshold', 0),
    step('ramps', 0),
    step('motor_torque', -38.7),
    step('battery_current', -5.6),
    step('market', 0),
    step('current_control', -0.1),
  ]
  return {
    moment: { kind: 'ride', ride_id: 1, t_s: 516.2, hold_s: null },
    config_source: 'ride',
    engine: '',
    warmed_up_s: 516,
    result: 'ok',
    law: 'fuzzy',
    mode: 4,
    mode_name: 'boost',
    table: null,
    speed_kmh: 16.8,
    cadence_rpm: 43,
    rider_torque_nm: 61.4,
    torque_rate: 0.52,
    rules: [],
    gain: 0.296,
    assist_ratio: 1.94,
    crank_rad_per_s: RAD_PER_S,
    steps,
    commanded_nm: 75.1,
    available_nm: 75.1,
    delivered_nm: 75,
    limit_flags: ['battery_current'],
    readings: {},
    settings: {
      gear_ratio: 40.34,
      mode_ratio: 1.5,
      pedal_torque_nm_min: 1,
      cutoff_kmh: 25,
      ramp_up_nm_per_s: 200,
      ramp_down_nm_per_s: 400,
      motor_torque_nm_max: 2,
      battery_current_a_max: 12,
      battery_voltage_v_min: 30,
      motor_speed_rpm_max: 3000,
    },
    recorded: null,
    differs: [],
    ...changes,
  }
}

it('names the hardest clamp first, with its watts', () => {
  expect(sentence(why(), say, units)).toBe(
    "Boost requested 119\u00a0Nm; 75\u00a0Nm was delivered. The motor's torque limit took " +
      "174\u00a0W, the battery's limit 25\u00a0W.",
  )
  expect(takers(why()).map(({ name }) => name)).toEqual(['motor_torque', 'battery_current'])
  expect(tableCannotHelp(why())).toBe(true)
})

it('says what the motor was commanded where nothing was measured', () => {
  const steady = why({ delivered_nm: null, steps: why().steps.slice(0, -1) })

  expect(sentence(steady, say, units)).toContain('the motor was commanded 75')
  expect(waterfall(steady).at(-1)?.name).toBe('commanded')
})

it.each([
  [{ law: 'off' as const }, 'Boost gives no assist: its law is off.'],
  [{ result: 'input_refused' as const }, 'The unit refused its readings and gave no torque.'],
  [
    { steps: [step('rider_torque', 0), step('mode_ratio', 0), step('brake', 0)] },
    'Boost requested nothing: no push that counts.',
  ],
  [
    {
      steps: [step('rider_torque', 20), step('mode_ratio', 0), step('brake', 0)],
      delivered_nm: 20,
    },
    'You got all that Boost requested: 20\u00a0Nm.',
  ],
])('%o', (changes, expected) => {
  expect(sentence(why(changes), say, units)).toBe(expected)
})

it("puts the law's demand before the clamps, each bar where the one before ended", () => {
  const rows = waterfall(why())

  expect(rows.map(({ kind }) => kind).join(' ')).toBe(
    'rider law law demanded clamp clamp clamp clamp clamp clamp delivered',
  )
  expect(demandedNm(why())).toBeCloseTo(119.4)
  for (const [i, row] of rows.entries()) {
    const before = rows[i - 1]
    if (before && row.kind !== 'demanded' && row.kind !== 'delivered') {
      expect(row.from_nm).toBe(before.to_nm)
    }
  }
  expect(rows.map((row) => rowValue(row, units).replace('\u00a0', ' '))).toEqual([
    ...['61.4 Nm', '+30.7 Nm', '+27.3 Nm', '119.4 Nm', '0 W', '0 W', '−174 W', '−25 W', '0 W'],
    ...['0 W', '75.0 Nm'],
  ])
})

it('clips each set at the hardest of its rules', () => {
  const rules = [
    { row: 2, column: 2, label: 'ZO' as const, weight: 0.64 },
    { row: 3, column: 3, label: 'ZO' as const, weight: 0.31 },
    { row: 2, column: 3, label: 'PS' as const, weight: 0.31 },
  ]
  const peaks = [0.1, 0.2, 0.3, 0.4, 0.5]
  const heightAt = (gain: number) =>
    gainShape(peaks, rules, false).union.find(([at]) => Math.abs(at - gain) < 1e-9)?.[1]

  expect(gainShape(peaks, rules, false).levels).toEqual([0, 0, 0.64, 0.31, 0])
  expect(gainShape(peaks, rules, true).levels[2]).toBeCloseTo(0.95)
  expect([heightAt(0.3), heightAt(0.4), heightAt(0.1)]).toEqual([0.64, 0.31, 0])
})

it('says the same with the same values in both languages', () => {
  const holes = (text: string) => [...text.matchAll(/\{(\w+)\}/g)].map((match) => match[1]).sort()

  for (const [key, text] of Object.entries(en)) {
    expect([key, holes(zh[key as Key])]).toEqual([key, holes(text)])
  }
})

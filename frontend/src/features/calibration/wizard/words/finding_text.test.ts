// @vitest-environment happy-dom
/* Goal: what the server says of a calibration is read in the reader's units and language, and says
   so where something is not reported. Sentences by hand; 5 Nm are 3.7 lbf·ft. */
import { FAULTS } from '$generated/registry'
import { expect, it } from 'vitest'
import { faultList } from '$shared/device/fault_text'
import { Locale } from '$shared/i18n/locale.svelte'
import { Units } from '$shared/units/units.svelte'
import { sentenceOf } from './finding_text'

const english = new Locale()
const metric = new Units(english, 'metric')
const imperial = new Units(english, 'imperial')
const check = (code: string, figure: number | null, more = {}) => ({
  code,
  passed: false,
  sentence: 'as the server says it',
  figure,
  allowed: 5,
  values: {},
  ...more,
})

it('a torque is in the reader’s units', () => {
  const foot = check('pedals_free', 6.2)

  expect(sentenceOf(english, metric, foot)).toMatch(/6\.2\sNm, 5\.0\sNm is allowed/)
  expect(sentenceOf(english, imperial, foot)).toMatch(/4\.6\slbf·ft, 3\.7\slbf·ft is allowed/)
})

it('what turns has its unit, what is not reported is a dash', () => {
  const finding = check('standing', null, { values: { wheel_kmh: 10, cadence_rpm: 60 } })

  expect(sentenceOf(english, imperial, finding)).toMatch(/wheel 6\.2\smph, crank 60\srpm, motor —/)
})

it('faults have their names', () => {
  const [one = '', two = ''] = Object.keys(FAULTS)
  const finding = check('faults', 2, { values: { names: `${one}, ${two}` } })

  expect(sentenceOf(english, metric, finding)).toBe(`faults: ${faultList(english, [one, two])}`)
  expect(sentenceOf(english, metric, check('faults', 0, { values: { names: '' } }))).toBe(
    'faults: none',
  )
})

it('a code of a newer server has the sentence of the server', () => {
  expect(sentenceOf(english, metric, check('of_tomorrow', 1))).toBe('as the server says it')
})

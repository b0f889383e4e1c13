/* Goal: the page of modes shows what is about modes and limits, once, and not what is a table's. */
import type { Finding, LintReport } from '$shared/api/types'
import { expect, it } from 'vitest'
import { modeFindings } from './mode_findings'

const finding = (code: string, where: string): Finding => ({ code, where, message: '', values: {} })
const report = (...warnings: Finding[]): LintReport => ({ errors: [], warnings, notes: [] })

it('shows a mode and a limit once, and nothing that is of a table', () => {
  const first = report(
    finding('demand_beyond_motor', 'modes[3]'),
    finding('cutoff_above_market', 'assist_cutoff_kmh'),
    finding('label_step', 'rules[2][0]'),
    finding('steep_gain', '10.0 km/h, torque rate 0.87'),
    finding('gain_at_steady_torque', 'torque rate 0'),
    finding('table_not_used', 'modes'),
  )
  const second = report(
    finding('demand_beyond_motor', 'modes[4].ratio'),
    finding('cutoff_above_market', 'assist_cutoff_kmh'),
  )

  const places = modeFindings([first, second]).warnings.map(({ code, where }) => [code, where])

  expect(places).toEqual([
    ['demand_beyond_motor', 'modes[3]'],
    ['cutoff_above_market', 'assist_cutoff_kmh'],
    ['demand_beyond_motor', 'modes[4].ratio'],
  ])
})

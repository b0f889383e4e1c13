// What is to be hung on next, in words.
import type { Locale } from '$shared/i18n/locale.svelte'
import type { Units } from '$shared/units/units.svelte'
import type { Job, Step } from '../job/types'
import { words } from '../words/words'

const KG_DIGITS = 2
const MM_PER_M = 1000

export interface Instruction {
  title: string
  note: string
  button: string
}

/** Of the step that is next; null: all are done. */
export function instructionOf(
  locale: Locale,
  units: Units,
  job: Job,
  step: Step | null,
): Instruction {
  const say = words(locale)
  if (!step) return { title: say('all_taken'), note: '', button: '' }
  const { kind, side, mass_kg, crank_angle_deg, stroke, direction } = step.state
  const pedal = side ? say(`pedal_${side}`) : ''
  const place = say('stroke_of', {
    stroke,
    count: job.setup?.strokes ?? stroke,
    direction: direction ? say(direction) : '',
    pedal,
  })
  if (kind === 'zero') {
    return { title: say('take_off', { pedal }), note: place, button: say('take_zero') }
  }
  const crank =
    crank_angle_deg === 0
      ? say('crank_level')
      : say('crank_at', { deg: locale.number(crank_angle_deg) })
  const nm = units.text(step.load_nm, 'Nm', 1)
  const arm_m = step.state.arm_m ?? job.setup?.arm_m ?? 0
  return {
    title: say('hang', { kg: locale.number(mass_kg, KG_DIGITS), pedal, crank }),
    note: `= ${nm}, ${locale.number(arm_m * MM_PER_M, 1)} mm · ${place}`,
    button: say('take', { nm }),
  }
}

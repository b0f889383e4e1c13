// What each figure of a calibration means, in one sentence.
import { pageWords } from '$shared/i18n/page_words.svelte'

export const en = {
  offset_counts: 'What the sensor says when nothing pulls at the pedals.',
  gain_nm_per_count: 'How many newton metres one count of the sensor is worth.',
  offset_counts_per_k: 'How far the zero walks for each kelvin the sensor gets warmer.',
  gain_share_per_k: 'By what share the scale grows for each kelvin the sensor gets warmer.',
  linearity_line: 'The largest distance of the mean readings from the best straight line.',
  hysteresis: 'Half the largest difference between the same load reached from above and below.',
  repeatability: 'How much one reading scatters when the same load is hung on again.',
  zero_return: 'How far the zero is from where it was once all loads are taken off.',
  total: 'The three errors of the sensor together, as the root of the sum of their squares.',
  left_right: 'How much more a load on the right pedal reads than the same on the left.',
  bending_across: 'What bending of the spindle across the crank adds to a reading.',
  fit: 'What the scatter of the captures leaves open of zero and scale.',
  linearity: 'What the straight line leaves of the sensor’s own curve.',
  masses: 'What the tolerance of the masses leaves open.',
  arm: 'What the length of the crank leaves open.',
  gravity: 'What the pull of the earth at this place leaves open.',
  level: 'What a crank that is not quite level leaves open.',
  resolution: 'Half a step of the reading, which it cannot tell.',
  step: 'Half a step of the readings while they were taken.',
  temperature: 'What the sensor may have walked while its temperature changed.',
  expanded: 'Within this of the reading the torque lies in 95 of 100 cases.',
  residual: 'What a reading by the new scale is above the load that hung there.',
  loop: 'How much more a load reads on the way down than on the way up.',
  spread: 'How far the raw counts of the last seconds scatter about their mean.',
  en: 'A difference in units of what its uncertainty explains: up to 1 it is explained.',
}
export type Figure = keyof typeof en

export const meanings = await pageWords(en, async () => (await import('./meaning_words_zh')).zh)

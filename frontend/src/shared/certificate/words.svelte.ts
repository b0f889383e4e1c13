// The words of a certificate. They come with it: the first page need not carry them.
import { pageWords } from '../i18n/page_words.svelte'

export const en = {
  title: 'What is proven',
  holds:
    'As far as the unit decides, no ride with these settings breaks the law of its market: ' +
    '{market}.',
  other_firmware:
    'Not proven for this unit: firmware {firmware} was proven, and the unit runs another one.',
  broken: 'Not proven: {what}',
  show: '{count} statements with their bounds',
  statement: 'For every ride, at every moment',
  bound: 'Proven',
  allowed: 'Law',
  by: 'By',
  never: 'never',
  cutoff: 'No motor at and above, between the points of a table too',
  band: 'What is asked falls to nothing over the last',
  walk: 'Without pedalling the motor pushes only below',
  gain: 'Gain between the points of the tables, at most',
  ratio: 'Motor at the crank for the hardest push, at most',
  market_ratio: 'Motor at the crank for the push of the moment, at most',
  torque: 'Motor torque at the crank, at most',
  power_peak: 'Power the motor is told at any moment, at most',
  power_continuous: 'Mean power the motor is told over half an hour, at most',
  pedal_stop: 'Assist outlives pedalling by at most',
  push_stop: 'Assist outlives the last push by at most',
  cut: 'Nothing after cut-off speed, brake, fault or empty battery, within',
  lost_reading: 'Nothing without a new torque reading, within',
  rise: 'Torque at the crank rises by at most',
  at_most: '≤ {value}',
  at_least: '≥ {value}',
  times: '{value} ×',
  structure: 'structure of the law',
  interval: 'bounds over each cell',
  recursion: 'what filters and ramps remember',
  not_covered:
    "Not covered: how true the torque sensor's gain and the wheel's circumference are, how late " +
    'readings come, whether the motor gives what it is told, a unit that is switched off and on, ' +
    'another firmware.',
  identity: 'Certificate {certificate}, table {table}, firmware {firmware}, method {method}',
}

export type CertificateKey = keyof typeof en

export const words = await pageWords(en, async () => (await import('./words_zh')).zh)

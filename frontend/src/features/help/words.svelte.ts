// What the field's words mean, in a sentence or two. They come with the list, not with a page.
import type { Term } from '$shared/context/help.svelte'
import type { Values } from '$shared/i18n/locale.svelte'
import { pageWords } from '$shared/i18n/page_words.svelte'

type Explained = `${Term}.${'word' | 'means'}`
export type HelpKey =
  | Explained
  | 'words'
  | 'find'
  | 'nothing'
  | 'steps'
  | 'steps_again'

export const en: Record<HelpKey, string> = {
  words: 'Words',
  find: 'Find a word',
  nothing: 'No word here holds that.',
  steps: 'New here?',
  steps_again: 'Show the first steps on Bike',
  'rider_torque.word': 'Rider torque, motor torque',
  'rider_torque.means':
    'What you press on the cranks, and what the motor adds at them. They are two sources: ' +
    "Spindle never adds them up. One Nm at the motor's shaft is many Nm at the crank, by the " +
    'gear.',
  'torque_rate.word': 'Torque rate',
  'torque_rate.means':
    'How fast your torque grows: its relative change over a tenth of a second. 0 is steady ' +
    'pedalling, 0.5 means half as much again.',
  'assist_ratio.word': 'Assist ratio',
  'assist_ratio.means':
    'Motor torque at the crank for each Nm of yours, before gain, taper and limits. A ratio ' +
    'of 1 doubles your push.',
  'fixed_law.word': 'Fixed law',
  'fixed_law.means': 'Motor torque = your torque × the ratio, less and less as the taper begins.',
  'fuzzy_law.word': 'Fuzzy law',
  'fuzzy_law.means':
    'Motor torque = your torque × ratio × (1 + gain). The gain comes from a table of 25 ' +
    'rules over speed and torque rate.',
  'gain.word': 'Gain',
  'gain.means':
    "What the fuzzy law adds to a mode's ratio, 0 to 0.5. At 0.3 the motor gives 30 % more " +
    'than the ratio alone.',
  'labels.word': 'NB, NS, ZO, PS, PB',
  'labels.means':
    'The five gains a rule can name, from least to most: negative big, negative small, zero, ' +
    'positive small, positive big. They are names only: every gain is 0 or more, and ZO is ' +
    'the middle one, not zero.',
  'peaks.word': 'Peaks of the sets',
  'peaks.means':
    'Where each row, column or label counts fully. Between two peaks both neighbours count, ' +
    'each by its share.',
  'inference.word': 'Inference',
  'inference.means':
    'How rules that act together become one gain: by the centroid of clipped sets (Mamdani), ' +
    'or by the mean of their peaks, each with its weight. The second has no ripple between ' +
    'the points.',
  'taper.word': 'Taper',
  'taper.means':
    "How the fixed law's ratio falls with speed, between two speeds or by Japan's curve.",
  'cutoff_band.word': 'Cut-off and its soft band',
  'cutoff_band.means':
    'At the cut-off speed assist is over. In the band below it assist falls in a line, so ' +
    'that the motor does not switch on and off at the limit.',
  'ramps.word': 'Ramps',
  'ramps.means':
    'How fast assist may rise, and fall while nothing cuts it, in Nm a second. Brake, ' +
    'cut-off and faults are never ramped.',
  'pedal_stop.word': 'Pedal stop',
  'pedal_stop.means': 'How long the cranks may stand still before assist ends.',
  'ripple.word': 'Ripple',
  'ripple.means':
    "How much the motor's torque swings about its mean within half a turn of the cranks, as " +
    'a share of it. Less is smoother.',
  'lag.word': 'Lag',
  'lag.means':
    'The time until a sudden push has changed the motor by 63 % of all it will change.',
  'commanded.word': 'Requested, commanded, delivered',
  'commanded.means':
    'What the law asks for, what is told to the motor after every limit, and what arrives by ' +
    'its measured current. Energy counts only what was delivered.',
  'back_emf.word': 'Back-EMF',
  'back_emf.means':
    'The voltage a turning motor makes itself. Near its highest speed little battery voltage ' +
    'is left over it, so torque falls.',
  'battery_soc.word': 'State of charge',
  'battery_soc.means': 'How full the battery is, in percent of what it holds now.',
  'zero.word': 'Zero of the torque sensor',
  'zero.means':
    'The reading with no foot on the pedals. It drifts with temperature; a wrong zero is ' +
    'felt as assist without a push, or none with one.',
  'market.word': 'Market',
  'market.means':
    'Whose law the bike is ridden under. It is set by the maker, held last in the unit, and ' +
    'can only lower other limits.',
  'generation.word': 'Generation',
  'generation.means': 'The count of configurations a unit has had. It grows with every write.',
  'trial.word': 'Trial',
  'trial.means':
    'Settings that act for some seconds. The unit goes back by itself unless they are kept, ' +
    'even if the cable is pulled.',
  'closed_loop.word': 'Open and closed loop',
  'closed_loop.means':
    'Open loop: a recorded ride with another table, speed and legs as they were; it ranks ' +
    'tables. Closed loop: the same road ridden again by a fitted bike, so that speed answers ' +
    'too; an estimate with its band.',
  'certificate.word': 'Certificate',
  'certificate.means':
    'What is proven of every ride with a configuration: each statement with its bound, how it ' +
    'was proven, and what it does not cover, such as a wrong sensor gain or wheel size.',
}

export type Say = (key: HelpKey, values?: Values) => string

export const words = await pageWords(en, async () => (await import('./words_zh')).zh)

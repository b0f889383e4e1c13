// The topic that the reader opened. The explanations load when they are first opened.

/** The field's words that Spindle explains, in the order of the list. */
export const TERMS = [
  'rider_torque',
  'torque_rate',
  'assist_ratio',
  'fixed_law',
  'fuzzy_law',
  'gain',
  'labels',
  'peaks',
  'inference',
  'taper',
  'cutoff_band',
  'ramps',
  'pedal_stop',
  'ripple',
  'lag',
  'commanded',
  'back_emf',
  'battery_soc',
  'zero',
  'market',
  'generation',
  'trial',
  'closed_loop',
  'limit_proof',
] as const
export type Term = (typeof TERMS)[number]

/** A word, all of them, or the keys. */
export type HelpTopic = Term | 'words' | 'keys'

export class Help {
  /** Null while the help is closed. */
  topic = $state.raw<HelpTopic | null>(null)
}

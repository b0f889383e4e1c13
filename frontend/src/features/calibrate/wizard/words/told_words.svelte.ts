// What the server says with a code. Its own sentence is the English.
import { pageWords } from '$shared/i18n/page_words.svelte'

export const TOLD = [
  'standing',
  'pedals_free',
  'supply',
  'temperature',
  'faults',
  'too_short',
  'end_of_range',
  'stuck',
  'outliers',
  'drifting',
  'swinging',
  'noisy',
  'temperature_moving',
  'turning',
  'readings_missing',
  'no_readings',
  'order',
  'swapped_pedal',
  'too_few_loads',
  'looks_like_nm',
  'looks_like_kg',
  'looks_like_lb',
  'against',
  'slope',
  'wrong_mass',
  'crank_angle',
  'too_few_captures',
  'no_strokes_right',
  'no_strokes_left',
  'linearity',
  'hysteresis',
  'total',
  'repeatability',
  'no_zero_return',
  'zero_return',
  'uncertainty',
  'reference',
  'no_temperature',
  'no_left_right',
  'no_angles',
  'left_right',
  'bending',
  'not_verified',
  'verification',
  'gain_not_noise',
] as const
export type ToldCode = (typeof TOLD)[number]

const en = Object.fromEntries(TOLD.map((code) => [code, '{sentence}'])) as Record<ToldCode, string>
const zh = async () => (await import('./told_words_zh')).zh

export const told = await pageWords(en, zh)

// What the server says with a code. Its own sentence is the English, unless what it tells of has
// other units for some readers.
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
  'unlike_made',
] as const
export type ToldCode = (typeof TOLD)[number]

const en: Record<ToldCode, string> = {
  ...(Object.fromEntries(TOLD.map((code) => [code, '{sentence}'])) as Record<ToldCode, string>),
  standing: 'nothing turns: wheel {wheel_kmh}, crank {cadence_rpm}, motor {motor_rpm}',
  pedals_free: 'nobody on the pedals: {figure}, {allowed} is allowed',
  temperature: 'the temperature is steady: {figure} in a minute, {allowed} is allowed',
  faults: 'faults: {names}',
  temperature_moving: 'the sensor’s temperature changed by {figure}',
  turning: 'the bike moves: {speed_kmh}, crank {cadence_rpm}',
  verification: 'the verification is off by {figure} times what its uncertainty explains',
}
const zh = async () => (await import('./told_words_zh')).zh

export const told = await pageWords(en, zh)

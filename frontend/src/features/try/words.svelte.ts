// The words of the same road again. They come with the page: the first page need not carry them.
import type { Values } from '$shared/i18n/locale.svelte'
import { pageWords } from '$shared/i18n/page_words.svelte'

export const en = {
  title: 'The same road again: an estimate',
  mass: 'Rider and bike',
  running: 'A twin of the bike rides the road again…',
  sentence:
    'Again with it: {low} to {high} of motor work instead of {recorded}, in {soon} to {late}.',
  meaning:
    'Here the bike answers. The band holds how you may pedal at another speed; gusts are ' +
    'averaged. The largest torque and how steeply it rises cannot be forecast.',
  trust: 'With nothing changed the twin is off by {work} of work, {time} of time.',
  shifts:
    'Speed and cadence do not fit one gear: at another speed the twin shifts to keep your ' +
    'cadence, and the band holds those who shift less.',
  estimate: 'again',
  band: 'nine of ten',
  wh_per_km: 'Motor work by distance',
  motor_work_wh: 'Motor work',
  battery_wh: 'From the battery',
  km_per_100_wh: 'Range of 100 Wh',
  rider_work_wh: 'Your work',
  duration_s: 'Time',
  motor_power_w_mean: 'Motor power, mean while moving',
  ripple_nm_per_s: "Ripple: how fast the motor's torque changes",
  torque_nm: 'Largest motor torque',
  asked_nm: 'Largest motor torque requested',
  limits: 'Time held back by',
  no_battery: 'The ride did not record what left the battery, so there is no range.',
  no_limits: 'The ride does not tell its limits.',
  curves: 'Three rides over one road',
  along: 'Drawn over',
  km: 'distance',
  time: 'time',
  recorded: 'as ridden',
  unchanged: 'again, nothing changed',
  replayed: 'again with it',
  torque: 'Motor torque at the shaft',
  apart: 'What the change gives more or less',
  speed: 'Speed',
  more: 'more',
  less: 'less',
  at: 'At {place}',
  keys: 'Press the picture, or ← → to move; K changes between distance and time.',
}

export type TryKey = keyof typeof en

export type Say = (key: TryKey, values?: Values) => string

export const words = await pageWords(en, async () => (await import('./words_zh')).zh)

// The words of one ride's page. They come with it: the first page need not carry them.
import type { Values } from '$shared/i18n/locale.svelte'
import { pageWords } from '$shared/i18n/page_words.svelte'

export const en = {
  loading: 'Reading this ride… its figures come first, then its traces.',
  distance: 'Distance',
  moving: 'Moving',
  of_time: 'of {time}',
  mean_speed: 'Mean speed',
  top: 'top {value}',
  cadence: 'Cadence',
  your_energy: 'Your energy',
  motor_energy: 'Motor energy',
  from_battery: 'From the battery',
  per_yours: 'Motor per yours',
  mean_top: 'mean {mean}, top {top}',
  cranks_turning: 'while the cranks turn',
  battery_used: '{share} of its charge, {per_km}',
  per_km: '{per_km}',
  wh_for_each: 'Wh for each Wh of yours',
  odometer: 'as its odometer counted',
  from_speed: 'speed over time',
  not_asked: 'only asked, not measured',
  none_speed: 'no speed recorded',
  none_cadence: 'no cadence recorded',
  none_rider: 'no torque or power of yours',
  none_motor: 'no motor power recorded',
  none_battery: 'no voltage and current',
  none_ratio: 'takes both energies',
  none_moving: 'it never moved',
  delete: 'Delete',
  export: 'Export…',
  export_title: 'Take this ride away',
  close: 'Close',
  report: 'Report (HTML)',
  share_title: 'to share',
  share:
    'To share with strangers: without {metres} m around start and end, later passes too; ' +
    'distance and time begin behind, and no name is in it.',
}

export type RideKey = keyof typeof en
export type RideSay = (key: RideKey, values?: Values) => string

export const words = await pageWords(en, async () => (await import('./words_zh')).zh)

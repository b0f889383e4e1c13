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
  your_energy: 'Your energy',
  motor_energy: 'Motor energy',
  from_battery: 'From the battery',
  per_yours: 'Motor to you',
  mean_top: 'mean {mean}, top {top}',
  battery_used: '{share} of its charge, {per_km}',
  per_km: '{per_km}',
  wh_for_each: 'Wh for each Wh of yours',
  odometer: 'as its odometer counted',
  from_speed: 'speed over time',
  not_asked: 'only asked, not measured',
  none_speed: 'no speed recorded',
  none_rider: 'no torque or power of yours',
  none_motor: 'no motor power recorded',
  none_battery: 'no voltage and current',
  none_ratio: 'needs both energies',
  none_moving: 'it never moved',
  climb: 'Climb',
  of_heights: 'by heights, {descent} down',
  none_height: 'no height recorded',
  track: 'Track',
  own_positions: 'from its own positions, no map service',
  no_positions_height: 'no positions: height over the way',
  no_positions: 'This ride has no positions and no heights, so there is no track to draw.',
  track_drawn:
    'Track of the ride from its own positions, north up; the traces tell it by time.',
  height_drawn: 'Height of the ride over its way',
  start: 'start',
  end: 'end',
  north: 'N',
  overview: 'Whole ride, {of}: drag to choose a window',
  window_from: 'Window begins',
  window_to: 'Window ends',
  channels: 'Channels',
  more_channels: '{count} more channels',
  fewer_channels: 'Fewer channels',
  axis: 'Axis',
  axis_time: 'Time',
  axis_moving: 'Moving time',
  axis_distance: 'Distance',
  axis_none: 'This ride tells no speed and no way.',
  cursor: 'cursor {at}',
  keys: 'arrow keys move it, Shift by a minute; W whole, N next event',
  no_cursor: 'Press on the traces to read every channel',
  at_cursor: 'Every channel at {at}',
  in_gap: 'no sample here',
  why: 'Why this much assist?',
  why_short: 'why',
  compare: 'Compare with…',
  compare_window: 'Compare this window with…',
  go_to: 'Show {at} in the traces',
  why_at: 'Why this much assist at {at}?',
  events: 'Events',
  clock_set_forward: 'The clock was set forward by {by}: the ride is dated anew',
  clock_set_back: 'The clock was set back by {by}: the ride is dated anew',
  days_and: '{days} d {rest}',
  mode: 'Mode {number}',
  delete: 'Delete',
  export: 'Export…',
  export_title: 'Take this ride away',
  damage_missing: 'The file of this ride’s samples is missing.',
  damage_wrong_size: 'The file of this ride’s samples has not the size it was written with.',
  damage_changed: 'The file of this ride’s samples is damaged.',
  damage_unreadable: 'The disk does not let the file of this ride’s samples be read.',
  damage_row: 'The row of this ride in the database is damaged.',
  row_what_to_do:
    'It is mended by itself while its file is whole. If this stays, restore the file from a ' +
    'backup.',
  damage_what_to_do:
    'The figures below were computed before and are right; samples are not shown nor exported. ' +
    'Restore the file from a backup, or delete the ride and import its file again.',
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

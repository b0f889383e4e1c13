// The words of where everything is kept. They come with the page.
import type { Values } from '$shared/i18n/locale.svelte'
import { pageWords } from '$shared/i18n/page_words.svelte'

export const en = {
  rider: 'Rider',
  threshold: 'Threshold power',
  heart_rate: 'Greatest heart rate',
  rider_note:
    'What you can hold for an hour, and your pulse at your limit. Zones of a ride are shares of ' +
    'them. Kept in this browser; empty if you do not know.',
  data: 'Data and backup',
  folder: 'Rides and files',
  database: 'Database',
  holds: 'Kept',
  holds_all: '{rides} rides · {size}',
  free: 'Free on that disk',
  unknown: '— the server does not answer',
  backup: 'Save a backup',
  backup_note:
    'One zip of everything as it is now: rides, originals, units, settings’ history and library. ' +
    'The database is checked before it is sent; a zip that was cut short does not open.',
  backup_server:
    'The database is on a server and is not in the zip: save it with pg_dump as well. ' +
    'The zip alone brings every ride back.',
  restore: 'How to bring it back',
  restore_stop: 'Stop this Spindle.',
  restore_unpack: 'Unpack the zip into an empty folder.',
  restore_check: 'See that everything is there:',
  restore_start: 'Start from it:',
  restore_rebuild: 'If only the database is damaged, this makes it anew from the rides’ own files:',
  place: 'FOLDER',
  tables: 'Tables you answered for',
  tables_note:
    'What you said of tables that do not name their units or time zone, by their columns. ' +
    'Forget an answer to be asked again with the next such file; rides that were read stay.',
  rows_a_second: '{count} rows a second',
  forget: 'Forget',
  forget_named: 'Forget what was said of {columns}',
  language: 'Language',
  language_not_fetched:
    'The words of that language could not be fetched. Is the server running?',
  theme: 'Appearance',
  units: 'Units',
  author: 'Your name',
  author_note:
    'Kept with your changes, as stated: nobody signs in yet. ' +
    'Empty: the name the server runs under.',
  units_note: 'Only what is shown changes; the unit and the files keep SI units.',
  server: 'This Spindle',
  version: 'Version',
  keeps: 'Keeping records',
  keeps_ok: 'everything that is to be kept is kept',
  keeps_degraded: 'not everything can be saved now: see the message above',
  keeps_unknown: 'not known: the server does not answer',
  rows: '{saved} rows saved since it started, {waiting} waiting, {lost} lost, {missing} never came',
  api: 'Description of the API',
}

export type SettingsKey = keyof typeof en
export type Say = (key: SettingsKey, values?: Values) => string

export const settingsWords = await pageWords(en, async () => (await import('./words_zh')).zh)

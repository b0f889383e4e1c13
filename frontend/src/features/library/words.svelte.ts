// The words of this page. They come with it: the first page need not carry them.
import type { Values } from '$shared/i18n/locale.svelte'
import { pageWords } from '$shared/i18n/page_words.svelte'

export const en = {
  entries: 'Tables and configurations',
  lead: 'Nothing here writes to a bike: an entry is opened as a draft, which is reviewed first.',
  name: 'Name',
  kind_table: 'table',
  kind_configuration: 'configuration',
  preset: 'comes with Spindle',
  own: 'own, {when}, {author}',
  own_nobody: 'own, {when}',
  feel: 'Feel, measured on the simulated bike',
  start_s: 'To 15 km/h',
  rise_nm_per_s: 'Steepest rise',
  ripple_pct: 'Ripple',
  lag_ms: 'Lag',
  toggles_hz: 'On and off at 25 km/h',
  start_unit: '{value} s',
  rise_unit: '{value} Nm/s',
  ripple_unit: '{value} %',
  lag_unit: '{value} ms',
  toggles_unit: '{value} a second',
  feel_how:
    'Simulated: 100 kg on the level, legs of 24 Nm. Rise at the motor shaft; ripple about the ' +
    'mean of half a turn; lag to 63 % of a sudden push.',
  open: 'Open as a draft',
  open_unit: 'needs a connected unit',
  opened: '{name} is a draft now. Nothing is in the unit yet.',
  files: 'Files',
  delete: 'Delete',
  deleted: '{name} is deleted.',
  undo: 'Undo',
  undone: '{name} is back.',
  compare: 'Compare',
  left: 'A',
  right: 'B',
  here: 'On the bike',
  draft: 'The draft',
  unit: 'The unit now',
  presets: 'Come with Spindle',
  mine: 'Own',
  history: 'What the unit had',
  revision: '{when} · {reason}',
  revision_by: '{when} · {author} · {reason}',
  no_reason: 'no reason given',
  same: 'The two are the same.',
  differ: '{cells} rules differ.',
  largest:
    'The gain differs by at most {gain}, from {left} to {right}, at {speed} and a torque rate ' +
    'of {rate}.',
  no_table: 'One of them has no table: only its settings are compared.',
  not_felt: '{name}: {why}',
  rules: 'Rules of A, and of B where they differ',
  cell_same: '{label} at {speed}, torque rate {rate}',
  cell_differs: '{left} in A, {right} in B, at {speed}, torque rate {rate}',
  map: 'Gain of B less that of A',
  settings: 'What differs',
  save: 'Keep in the library',
  save_table: 'Table of the draft',
  save_first: 'First table of the draft',
  save_second: 'Second table of the draft',
  replaces: 'An own entry has this name. It becomes its version {version}; what it was is kept.',
  replace_button: 'Replace',
  versions: '{count} versions',
  version: '{version} · {when}',
  version_by: '{version} · {when} · {author}',
  version_deleted: '{version} · {when} · deleted',
  bring_back: 'Bring back',
  is_back: '{name} is again what it was as version {version}.',
  save_configuration: 'Whole configuration of the draft',
  save_button: 'Save',
  saved: '{name} is in the library.',
  name_needed: 'Give it a name first.',
  import: 'Import a file',
  import_note: 'A JSON file of the library or a backup, or a .fis file of MATLAB.',
  imported: '{name} is in the library.',
  imported_fis:
    '{name} is in the library. The unit differs from the file by at most {gain}, at {speed} and ' +
    'a torque rate of {rate}.',
  not_json: '{name} is neither JSON nor a .fis file.',
  waits: 'Choose two to compare.',
}

export type LibraryKey = keyof typeof en
export type Say = (key: LibraryKey, values?: Values) => string

export const words = await pageWords(en, async () => (await import('./words_zh')).zh)

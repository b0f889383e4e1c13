// The words of the review before a write, and of what becomes of it. They come with the dialog.
import type { Values } from '../i18n/locale.svelte'
import { pageWords } from '../i18n/page_words.svelte'

export const en = {
  title: 'Review before writing to {name}',
  what: 'What',
  old: 'In the unit',
  new: 'New',
  range: 'Allowed',
  rule: 'Rule at {speed}, torque rate {rate}',
  second_rule: 'Second table: rule at {speed}, torque rate {rate}',
  also_changed: 'Somebody else changed this meanwhile; it was {was} when you began.',
  changed_beside: 'Changed in the unit since you began, and kept: {changes}.',
  nothing: 'Nothing differs from the unit.',
  reason: 'Reason (kept with the revision)',
  reason_hint: 'for instance: softer start on wet climbs',
  back: 'Back to editing',
  write: 'Write to the unit',
  writing: 'Writing…',
  verified:
    'Written and read back, field by field: verified ({count} changed), generation ' +
    '{generation}.',
  needs_restart:
    'Written, {count} parameters, generation {generation}. Restart the unit to apply it.',
  undone_needs_restart:
    'The old values are written, generation {generation}. Restart the unit to apply them.',
  undo: 'Undo',
  undo_reason: 'Undo of the last change',
  undone: 'Undone: the old values are back and verified, generation {generation}.',
  not_undone: 'Not undone.',
  stop_undo: 'Stop the simulated rider and undo',
  stop_write: 'Stop the simulated rider, write, let the rider go on',
  stopping:
    'The simulated rider stops; the change is written as soon as the bike stands still.',
  moving:
    'Nothing was written: the wheel or the motor turns. A new configuration is taken ' +
    'only at standstill, so that assist cannot change under the rider. Stop the bike and ' +
    'write again.',
  conflict:
    'Nothing was written: somebody else changed the unit in the meantime. The column "In ' +
    'the unit" now shows what it has; look again, then write.',
  refused: 'Nothing was written:',
  silent: 'Nothing was written, because the unit does not answer:',
  unknown:
    'It is not known whether the change was written. Once the unit answers, the column "In the ' +
    'unit" says what it has:',
  changed:
    'It is written: the answer was lost, but the unit was asked again and has the change, as the ' +
    'column "In the unit" shows.',
  differs: 'What the unit holds now is not what was meant:',
  not_connected:
    'The unit is not connected, so nothing can be written. Your edits are kept.',
  manner: 'How',
  for_good: 'For good',
  on_trial: 'On trial: keep it or it goes back by itself',
  seconds: 'Seconds to decide (5 to 255)',
  try: 'Try for {seconds} s',
  trial_explain:
    'Unless you press Keep in time, the unit returns to what it has now; also after a restart ' +
    'or when it loses power.',
  tried: 'Written, read back and verified. On trial now: keep it, or it goes back.',
  trial_runs:
    'A change is on trial in this unit. Keep or revert it first (the bar at the top of the page).',
  unlock_title: 'Token of the maker',
  unlock_explain:
    'Hand the challenge to the maker of the unit, who signs it with “spindle unlock sign”. The ' +
    'token is for this unit and exactly this change, and for one attempt.',
  unlock_nonce: 'Number of this challenge',
  unlock_hash: 'SHA-512 of the configuration',
  unlock_holds: 'Holds',
  unlock_left: 'for {time} more',
  unlock_over: 'no longer: ask for a new challenge',
  unlock_renew: 'Ask for a new challenge',
  unlock_challenge: 'Challenge for the maker',
  unlock_copy: 'Copy',
  unlock_copied: 'The challenge is in the clipboard.',
  unlock_save: 'Save as a file',
  unlock_token: 'Token from the maker',
  unlock_file: 'Token from a file…',
  unlock_not_token: 'This is no token: it has 144 characters from 0 to 9 and a to f.',
  unlock_write: 'Write with the token',
}

export type ReviewKey = keyof typeof en
export type ReviewSay = (key: ReviewKey, values?: Values) => string

export const reviewWords = await pageWords(en, async () => (await import('./review_words_zh')).zh)

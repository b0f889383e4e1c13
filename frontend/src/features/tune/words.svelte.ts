// The words of this page's tools. They come with it: the first page need not carry them.
import type { Values } from '$shared/i18n/locale.svelte'
import { pageWords } from '$shared/i18n/page_words.svelte'

export const en = {
  block_tools: 'What is done to the chosen rules',
  up_to: 'Up to…',
  up_to_hint: 'The next cell pressed is the other corner of the block',
  up_to_next: 'Now press the other corner of the block.',
  all: 'All',
  copy: 'Copy',
  copied: 'The chosen rules are in the clipboard.',
  paste: 'Paste',
  paste_forbidden:
    'The browser does not let this page read the clipboard: use Ctrl+V in the rules.',
  level: 'Level',
  level_hint: 'All at their mean gain',
  scale: 'Scale',
  scale_hint: 'Their gain times a factor',
  cancel: 'Cancel',
  scale_title: 'Scale the chosen rules',
  scale_percent: 'Their gain, in % of what it is',
  scale_range: 'Give {least} to {most} %.',
  scale_note:
    'Rules hold labels: each takes the label whose gain is nearest. To scale the gain of a whole ' +
    'table exactly, move its gain peaks.',
  would_move: '{moved} of {count} rules would move.',
  interpolate: 'Line',
  interpolate_hint: 'Evenly from corner to corner, or from end to end',
  smooth: 'Smooth',
  smooth_hint: 'Each the mean of itself and its neighbours',
  moved: '{moved} of {count} rules moved to the nearest label.',
  moved_none: 'No rule moved: each has the label that is nearest already.',
  fires_now: 'fires now',
  felt: 'At {push} from you: {asked} requested, {given} delivered at the crank.',
  felt_unit: 'In the unit {asked} are requested.',
  rescale: 'Rescale the torque-rate points to your rides…',
}

export type TuneKey = keyof typeof en

export type Say = (key: TuneKey, values?: Values) => string

export const words = await pageWords(en, async () => (await import('./words_zh')).zh)

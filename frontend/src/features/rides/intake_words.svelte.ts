// The words of files that come in. They come with their page: the first page need not carry them.
import { pageWords } from '$shared/i18n/page_words.svelte'

export const en = {
  going: 'Importing {count} files',
  over: '{count} files are in',
  done: '{done} of {count} done',
  seconds: 'about {count} s left',
  minutes: 'about {count} min left',
  pause: 'Pause',
  resume: 'Go on',
  stop: 'Stop',
  waiting: 'Waits for its turn.',
  stopped: 'Not sent. Choose it again and it goes on where it stood.',
  away: 'Paused: the server does not answer. Nothing is lost; go on when it does.',
  count_complete: '{count} read completely',
  count_here: '{count} already here, not taken twice',
  count_partial: '{count} damaged, read in part',
  count_rejected: '{count} not read: why, and what to do',
  count_waiting: '{count} wait for their turn',
  count_sending: '{count} on their way',
  count_stopped: '{count} not sent',
  more: 'and {count} more',
  folder: 'Choose a folder…',
  none_yet: 'No rides yet',
  none_what:
    'Drop ride files anywhere on this page (FIT, GPX, TCX, CSV), fetch what the unit has kept, ' +
    'or look round with a sample ride. Damaged files are read as far as they go.',
  live: 'Ride and record',
  sample: 'Open the sample ride',
  sample_name: 'Sample ride, simulated',
  sample_notes: 'Simulated by Spindle to look round with: nobody rode it.',
  fetch_from: 'Fetch from the unit ({count})',
  unfetched: 'Rides in the unit, not fetched: {count}',
  fetch_all: 'Fetch them ({count})',
  import: 'Import files…',
  fetched_before: 'Fetched before, and still in the unit.',
}

export type IntakeKey = keyof typeof en

export const words = await pageWords(en, async () => (await import('./intake_words_zh')).zh)

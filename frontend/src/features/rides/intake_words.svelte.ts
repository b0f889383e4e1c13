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
}

export type IntakeKey = keyof typeof en

export const words = await pageWords(en, async () => (await import('./intake_words_zh')).zh)

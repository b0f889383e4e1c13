// The words of which keys there are. They come with the list.
import { pageWords } from '../i18n/page_words.svelte'

export const en = {
  go:
    '? lists these keys. g, then b Bike, l Live, t Tune, c Calibrate, s Service, r Rides.',
  bike: 'Enter opens the first thing to do.',
  live:
    'M marks the moment in the ride. Space pauses the strips; then ← → move the cursor, ' +
    'Shift by 1 s.',
  rules:
    'Arrows move, Shift with arrows selects, 1 to 5 set NB to PB, + and − nudge, = levels, ' +
    '* scales, / interpolates, S smooths, Ctrl+C and Ctrl+V copy and paste as text, Delete ' +
    'restores, Ctrl+Z and Ctrl+Y undo and redo.',
  try:
    'O and C switch the lines of open and closed loop. On the road’s lines ← → move the cursor, ' +
    'Shift further; K shows km or time.',
  why: '← → move the moment, Shift by 1 s, N and P go to the next and last cut.',
  sensor: 'Space captures a reading, Backspace takes the last one back.',
  numbers: 'Numbers',
  numbers_text: 'Arrow up and down nudge; with Shift five times as far.',
}

export type KeyWord = keyof typeof en

export const keyWords = await pageWords(en, async () => (await import('./key_words_zh')).zh)

// The words of the drift watch. They come with the page.
import type { Values } from '$shared/i18n/locale.svelte'
import { pageWords } from '$shared/i18n/page_words.svelte'

export const en = {
  title: 'Drift of the zero',
  about: 'What the sensor read while you coasted, ride by ride',
  level_ok: 'The zero holds.',
  level_watch: 'The zero has moved by more than weather moves it. Watch it.',
  level_act: 'Calibrate now: at rest the unit takes this zero for a fault and gives no assist.',
  level_none: 'No ride has told the zero since the last calibration.',
  none: 'No ride has told the zero yet. Coast for some seconds: pedals still, wheel turning.',
  latest: 'Latest zero',
  latest_is: '{zero} ± {wide} (k = 2), {date}',
  at_degc: 'at {degc}',
  by_age: 'By age',
  a_month: '{nm} a month',
  by_temperature: 'By temperature',
  between: '95 %: {low} to {high}',
  no_thermometer: 'not told apart: too few rides tell the temperature of the sensor',
  same_weather: 'not told apart: all rides were within 5 K',
  few_rides: 'Not enough rides to say how it drifts: four or five more with a zero may do.',
  short_time: 'Not enough rides to say how it drifts: they must span two weeks of one calibration.',
  none_since_calibration: 'How it drifts is told again after the next ride that coasts.',
  next: 'Next calibration',
  calibrate_by: 'Before {date}. The zero reaches {nm} about {at} (90 %: {earliest} to {latest}).',
  later: 'later than five years from now',
  not_expected: 'It is not expected to reach {nm} within five years; it might from {earliest} on.',
  not_in_sight: 'Not in sight: it reaches {nm} in no less than five years.',
  over: 'Due: the trend is beyond {nm}.',
  by_rides: 'From {count} rides, at {degc}. Rides scatter by {scatter}.',
  by_rides_plain: 'From {count} rides. Rides scatter by {scatter}.',
  drawn: 'The zero of each ride over time, with its trend and the interval of 90 %',
  watch: 'watch',
  act: 'assist stops',
  calibrated: 'calibrated',
  colder: 'colder',
  warmer: 'warmer',
  rides: 'Every ride as a number',
  began: 'Ride',
  zero: 'Zero',
  sigma: 'Uncertainty',
  counts: 'Counts',
  temperature: 'Sensor',
  note: 'Note',
  no_torque: 'no torque recorded',
  no_cadence: 'no cadence recorded',
  no_speed: 'no speed recorded',
  no_coasting: 'no five seconds of coasting',
  not_still: 'the torque moved whenever it coasted',
  foot: 'more than 8 Nm while coasting: a foot, or a broken sensor',
  disagree: 'its stretches of coasting disagree',
  unreadable: 'its rows cannot be read',
  apart: 'left out: far from all other rides',
  no_temperature: 'left out: no temperature',
  other_compensation: 'left out: another temperature compensation',
  calibrated_as: 'Calibrated as configuration {seq}',
}

export type DriftKey = keyof typeof en

export type Say = (key: DriftKey, values?: Values) => string

export const driftWords = await pageWords(en, async () => (await import('./drift_words_zh')).zh)

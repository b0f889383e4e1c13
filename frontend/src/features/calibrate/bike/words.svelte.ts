// The words of the bike's other numbers. They come with the section.
import { pageWords } from '$shared/i18n/page_words.svelte'

export const en = {
  title: "The bike's other numbers",
  about: 'The legal cut-off rests on wheel and pulses; a climb checks the torque without a mass',
  wheel: 'Wheel',
  pulses: 'Speed pulses',
  cadence: 'Cadence',
  climb: 'Climb',
  coast: 'Coast-down',
  no_rides: 'No ride tells what is needed here',
  part: 'Part in question: {from} – {to}. Drag over the picture to choose another one.',
  whole_ride: 'all of it',
  measure: 'Measure',
  count: 'Count',
  check: 'Check',
  compare: 'Compare',
  way_rolled: 'Rolled out',
  way_known: 'Known',
  way_track: 'By positions',
  how_rolled:
    'Rider on the saddle, valve down: roll straight from a mark to where the valve is down ' +
    'again. Twice or more.',
  how_known: 'A circumference that somebody measured, and within what.',
  how_track:
    '1 km or more whose speed was counted by the wheel, with positions: straight, under an ' +
    'open sky. Bends and noise are in the uncertainty; beyond 2 % the ride is refused.',
  turns: 'Turns a roll',
  tape: 'Tape within ±',
  roll: 'Roll {number}',
  more_rolls: 'One more roll',
  circumference: 'Circumference',
  within: 'Within ±',
  ride_of_wheel: 'Ride whose speed is of the wheel',
  ride_of_positions: 'Ride of another device at the same time, with positions',
  counted_with: 'Device counted with',
  counted_with_note: "Left empty: as the ride's own configuration says.",
  way_in_turns: '{way} in {turns} turns',
  noise: 'positions within {noise} (k = 1)',
  in_unit: 'The unit counts with',
  off_by: 'Measured, from that',
  free: 'A dealer may set',
  wheel_agrees: "The unit's circumference agrees within the uncertainty.",
  wheel_differs: "The unit's circumference differs by more than the uncertainty.",
  cut_off: 'Where it shows {shown} and its assist ends, the bike goes {real} ± {wide}.',
  needs_token: "To write it takes the maker's token.",
  propose: 'Propose {value}',
  proposed: 'It waits among the changes below.',
  how_pulses:
    'The unit tells no pulses, but the way they come to. Lift the wheel with the sensor, turn ' +
    'it by hand from a mark to the mark, 20 turns or more, and count. Still for 20 s: the ride ' +
    'is in the list.',
  ride_of_pulses: 'Ride of the wheel turned by hand',
  turns_by_hand: 'Turns counted',
  a_turn: 'pulses a turn',
  unit_made: 'the unit made {told} turns of {turns}',
  pulses_agree: 'The {kept} that the unit counts with agree.',
  pulses_differ: 'The unit counts with {kept}: its speed is wrong by that ratio.',
  no_whole: 'It is no whole number: turns miscounted, or a magnet that is missed.',
  how_cadence:
    "The mean of the cadence that the unit told is compared with the turns that its crank's " +
    'angle made, 20 or more.',
  ride_of_crank: "Ride of this unit with the crank's angle",
  cadence_agrees: 'The cadence agrees with the turns of the crank.',
  cadence_differs: 'The cadence differs from the turns of the crank.',
  cadence_is: '{told} told, {error} off, ± {wide} (k = 2): {turns} turns in {time}.',
  how_climb:
    'A climb of known mass and height takes a known energy, whatever masses on the pedal said. ' +
    'Climb steadily with assist 0. Coast down twice, level or both ways, from 30 to 10 km/h in ' +
    'the same clothes: that tells rolling and air.',
  ride_of_climb: 'Ride',
  take_climb: 'This part is the climb',
  take_coast: 'This part is a coast-down',
  part_of: 'Part',
  when: 'From – to',
  rise: 'End above begin',
  rise_or_heights: "Empty: by the ride's heights",
  rise_by_hand: 'By a map or a survey',
  remove: 'Remove',
  no_coast: 'No coast-down: rolling and air are typical ones, and the climb tells little.',
  mass: 'Bike, rider, luggage',
  mass_within: 'Mass within ±',
  rise_within: 'Heights within ±',
  motor_off: 'The motor was off (needed where the ride does not tell what it gave)',
  climb_agrees: 'The climb agrees with the calibration.',
  climb_differs: 'The climb does not agree with the calibration.',
  climb_ratio: 'True torque is {ratio} ± {wide} (k = 2) of what the sensor tells; En {en}.',
  calibrated_given: 'The calibration knows it to ± {share}, as said.',
  calibrated_certificate:
    'The calibration knows it to ± {share}, by certificate {hash} of calibration {number}, {when}.',
  calibrated_unknown:
    "No certificate is kept of that calibration: only the climb's uncertainty counts.",
  energy_of: 'Energy of the climb, {rise} in {time}',
  energy_legs: 'Legs gave, as told',
  energy_motor: 'Motor gave',
  energy_gravity: 'Took: height',
  energy_kinetic: 'Took: speed',
  energy_rolling: 'Took: rolling',
  energy_air: 'Took: air',
  energy_drivetrain: 'Took: drivetrain',
  motor_by_word: "Nobody measured the motor; by the rider's word it was off.",
  open: 'What leaves it open (k = 1); together ± {share} (k = 2)',
  cause_mass_kg: 'Mass',
  cause_wheels_kg: 'Inertia of the wheels',
  cause_rise_m: 'Height',
  cause_gravity_ms2: 'Gravity',
  cause_efficiency: "Drivetrain's loss",
  cause_speed_share: "Wheel's circumference",
  cause_wind_ms: 'Wind',
  cause_road: 'Rolling and air',
  road_coast_down: 'By the coast-downs: rolling {rolling} N, air {air} N s²/m².',
  road_typical: 'Typical, not measured: rolling {rolling} N, air {air} N s²/m².',
  why_missing_channel: 'The ride lacks a channel that is needed.',
  why_missing_rows: 'The ride is silent for too long in that part: choose another one.',
  why_missing: "Nobody knows what the ride's device counted with.",
  why_too_rough: 'The positions are too rough to tell the circumference.',
  why_out_of_range: 'A value is out of range, or the ride is too short.',
  why_not_standing: 'The bike must stand at both ends of the part.',
  why_other_time: 'The other ride is of another time.',
  why_not_covered: 'The other ride does not cover that part.',
  why_too_slow: 'The rows are too far apart to tell turns.',
  why_too_few_turns: 'Too few turns to tell.',
  why_no_pulses: 'The unit told no speed there.',
  why_motor_unknown: 'The ride does not tell what the motor gave: say whether it was off.',
  why_motor_helped: 'The motor helped: climb with assist 0.',
  why_no_work: 'The legs gave nothing there.',
  why_too_short: 'The climb, or the fall of the speed, is too small to tell.',
  why_wrong_shape: 'The part has too few rows.',
}

export type BikeKey = keyof typeof en
type Of<Prefix extends string> = BikeKey extends infer Key
  ? Key extends `${Prefix}${infer Rest}`
    ? Rest
    : never
  : never

export const isReason = (code: string): code is Of<'why_'> => `why_${code}` in en
export const isCause = (code: string): code is Of<'cause_'> => `cause_${code}` in en

export const words = await pageWords(en, async () => (await import('./words_zh')).zh)

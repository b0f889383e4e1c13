// The words of the guided search. Of each cause: what it is, what to look at (a question that "yes"
// answers for it), and what to do if it is.
import type { Values } from '$shared/i18n/locale.svelte'
import { pageWords } from '$shared/i18n/page_words.svelte'

export const en = {
  guide: 'Guide me',
  title: 'Search: {fault}',
  step: 'Step {step} of {count}',
  reads_only: 'This only reads; nothing is written to the unit.',
  now: 'The unit reads now',
  points: 'speaks for it',
  against: 'speaks against it',
  says_nothing: 'watch how it changes',
  absent: '— the unit sends none',
  silent: '— the unit does not answer',
  yes: 'Yes, that is it',
  no: 'No, go on',
  back: 'Back',
  close: 'Close',
  found: 'Found: {cause}',
  found_none: 'None of the likely causes was found.',
  next_none:
    'Read the mechanic’s text of the fault again, and ask the maker with a backup of the unit.',
  looked_at: 'Looked at',
  is_it: 'it was this',
  is_not: 'not this',
  to_sheet: 'Put it on the job sheet',
  on_sheet: 'It is on the job sheet, under Done.',
  sheet_found: '{fault}: {cause}.',
  sheet_none: '{fault}: no cause found; looked at: {causes}.',

  'spindle_plug.is': 'plug at the spindle loose or wet',
  'spindle_plug.look': 'Pull the plug at the spindle. Is it wet or loose, or is a pin bent?',
  'spindle_plug.do':
    'Dry it, straighten the pin and push it in until it locks. The reading must leave the ' +
    'end of its range.',
  'bridge_arm.is': 'bridge arm open or shorted',
  'bridge_arm.look':
    'With the plug out, measure the arms of the bridge. Does one differ from the others?',
  'bridge_arm.do': 'Replace the spindle with its sensor, then calibrate offset and scale.',
  'rotor_supply.is': 'rotor board without power',
  'rotor_supply.look': 'Is the rotor’s last word older than 250 ms while the spindle stands?',
  'rotor_supply.do':
    'Check the supply of the rotor board and its solder joints; replace the board if it has ' +
    'power and stays silent.',
  'coil_gap.is': 'coils too far apart or out of line',
  'coil_gap.look':
    'Turn the cranks slowly by hand. Does the word grow old at the same place of each turn?',
  'coil_gap.do': 'Set gap and alignment of the coils, and check the bearing for play.',
  'amplifier.is': 'amplifier or rotor board stuck',
  'amplifier.look': 'Hold the brake and press a pedal by hand. Do the counts stay the same?',
  'amplifier.do': 'Replace the rotor board with its amplifier, then calibrate.',
  'foot_on_pedal.is': 'foot or load on a pedal at switch-on',
  'foot_on_pedal.look': 'Take everything off the pedals. Does the torque go below 3 Nm?',
  'foot_on_pedal.do': 'Switch on with free pedals; nothing is broken.',
  'zero_moved.is': 'zero of the sensor has moved',
  'zero_moved.look': 'Take everything off the pedals. Does the torque still read more than 3 Nm?',
  'zero_moved.do': 'Set the zero on the page Calibrate, and note the temperature.',
  'gauge_bond.is': 'bond of a gauge is failing',
  'gauge_bond.look':
    'Does the history of the settings show that the zero was set before and has moved again?',
  'gauge_bond.do': 'Replace the spindle with its sensor: a zero that keeps moving cannot be set.',
  'magnet.is': 'magnet moved, turned or gone',
  'magnet.look':
    'Turn the wheel by hand. Does the speed stay at nothing while the magnet passes the sensor?',
  'magnet.do':
    'Bring the magnet to the mark of the sensor and close to it; the speed must rise and ' +
    'fall with the wheel.',
  'speed_cable.is': 'cable or plug of the speed sensor damaged',
  'speed_cable.look': 'Turn the wheel and move cable and plug. Does the speed jump or break off?',
  'speed_cable.do': 'Replace sensor and cable; lay the cable so that nothing pulls at it.',
  'foreign_pulses.is': 'something else sends pulses',
  'foreign_pulses.look': 'Hold the wheel still. Is a speed told all the same?',
  'foreign_pulses.do':
    'Find what sends them: a device added to the cable, a second magnet, a cable beside the ' +
    'motor’s phases.',
  'wheel_settings.is': 'wheel or gear set otherwise than fitted',
  'wheel_settings.look':
    'Compare wheel, teeth and gear ratio on the page Modes with the bike. Does one differ?',
  'wheel_settings.do': 'Set what is fitted on the page Modes, with the reason.',
  'battery_empty.is': 'battery empty',
  'battery_empty.look': 'Is the charge below 5 %?',
  'battery_empty.do': 'Charge it fully, then read the voltage at rest.',
  'battery_contacts.is': 'contacts of the battery loose, wet or burnt',
  'battery_contacts.look':
    'Move the battery in its holder. Does the voltage jump, or is a contact burnt or wet?',
  'battery_contacts.do': 'Clean or replace the contacts and check the lock.',
  'battery_worn.is': 'battery or one cell group worn',
  'battery_worn.look':
    'Load the motor on a stand, with a full battery. Does the voltage fall below what the ' +
    'settings allow, or one cell group far below the others?',
  'battery_worn.do': 'Have the battery measured by its maker’s procedure, or replace it.',
  'battery_switch.is': 'battery’s management opened its switch',
  'battery_switch.look':
    'Read the battery’s own log or lamps. Do they name over-current, an empty cell or temperature?',
  'battery_switch.do': 'Mend what they name, then switch the battery on at standstill.',
  'motor_phase.is': 'phase of the motor shorted or broken',
  'motor_phase.look':
    'With the battery out, measure the three phases against each other and the housing. Does ' +
    'one differ?',
  'motor_phase.do': 'Replace cable or motor before the fault is cleared.',
  'gear_drags.is': 'gear drags or is blocked',
  'gear_drags.look': 'With the battery out, turn cranks and wheel by hand. Does it stick or grind?',
  'gear_drags.do': 'Mend the gear; a motor that cannot turn draws all the current it is given.',
  'power_stage.is': 'power stage of the controller failed',
  'power_stage.look':
    'With battery and motor unplugged, measure each phase against plus and minus. Is one shorted?',
  'power_stage.do': 'Replace the drive unit or its controller.',
  'hot_ride.is': 'long climb at full assist',
  'hot_ride.look': 'Did it come on a long or slow climb, and does the temperature fall now?',
  'hot_ride.do':
    'Nothing is broken: let it cool, ride a lower gear or mode. See the ride for where the ' +
    'heat came.',
  'motor_thermometer.is': 'thermometer of the motor wrong',
  'motor_thermometer.look': 'After an hour at rest: is the temperature far from that of the air?',
  'motor_thermometer.do': 'Check plug and sensor of the winding’s temperature, or replace it.',
  'hot_controller.is': 'long ride at full current',
  'hot_controller.look': 'Did it come on a long climb, and does the temperature fall now?',
  'hot_controller.do': 'Nothing is broken: let it cool, ride a lower gear or mode.',
  'heat_path.is': 'heat path from board to housing broken',
  'heat_path.look': 'Is the heat pad missing or dry, or the housing covered with mud?',
  'heat_path.do': 'Renew the pad and clean the housing.',
  'hall_plug.is': 'plug of the Hall sensors loose or wet',
  'hall_plug.look': 'Pull the plug of the Hall sensors. Is it wet or loose, or is a pin bent?',
  'hall_plug.do': 'Dry it, straighten the pin and push it in until it locks.',
  'hall_signal.is': 'a Hall sensor gives no signal',
  'hall_signal.look':
    'Turn the motor by hand. Is the supply of the sensors missing, or does one of the three ' +
    'signals not switch?',
  'hall_signal.do': 'Mend the supply, or replace the sensors or the motor.',
  'water.is': 'water in the unit',
  'water.look': 'Open the cover. Is the board wet, or are there traces of corrosion?',
  'water.do': 'Dry and clean it and renew the seal; replace the board if it is corroded.',
  'supply_dips.is': 'supply breaks off for moments',
  'supply_dips.look':
    'Move battery and plugs with the bike on. Does the voltage jump, or does the unit start anew?',
  'supply_dips.do': 'Clean or replace the contacts and plugs between battery and unit.',
  'settings_damaged.is': 'settings in the flash damaged',
  'settings_damaged.look':
    'Do the checks below call the settings in the flash damaged, or on defaults?',
  'settings_damaged.do':
    'Restore A from the history, or a backup; what the maker sets needs the maker’s token.',
  'flash_worn.is': 'flash worn out',
  'flash_worn.look': 'Were the settings restored before, and are they lost again?',
  'flash_worn.do': 'Replace the drive unit; its settings go into the new one from the backup.',
  'program.is': 'memory or program of the unit damaged',
  'program.look': 'Did it come again after switching off and on at standstill?',
  'program.do': 'Save a backup of the unit for the maker and replace the unit.',
  'never_set_up.is': 'factory’s last step missing',
  'never_set_up.look': 'Is the history of the settings empty, and was this unit never ridden?',
  'never_set_up.do': 'Send it to the maker, or write a whole configuration with the maker’s token.',
}

export type GuideKey = keyof typeof en
export type Say = (key: GuideKey, values?: Values) => string

export const guideWords = await pageWords(en, async () => (await import('./guide_words_zh')).zh)

// English: how things stand. Faults of the unit, what is not saved, what became of a change,
// and what needs the maker's token.
export const enState = {
  'faults.one': '1 fault',
  'faults.many': '{count} faults',
  'faults.warning_one': '1 warning',
  'faults.warning_many': '{count} warnings',
  'faults.no_assist': 'no assist',
  'faults.title': 'What is wrong with the unit',
  'faults.newer': '{name}, unknown to this Spindle',
  'faults.newer_text':
    "The unit's firmware is newer than this Spindle and does not say more. A Spindle that goes " +
    'with it knows what this fault means.',
  'faults.old': 'This is how it was when the unit was last seen.',
  'faults.check': 'What to check',
  'faults.announced': 'Fault of the unit: {names}.',
  'faults.announced_over': 'Over: {names}.',
  'faults.by_itself': 'It goes by itself a second after its cause.',
  'faults.clear_one': 'Clear the fault',
  'faults.clear_many': 'Clear the faults',
  'faults.forget': 'Clear the faults that are over',
  'faults.clearing': 'Clearing…',
  'faults.standing':
    'The bike stands still, so it can be cleared once its cause has been gone for a second. The ' +
    'unit decides.',
  'faults.moving':
    'The bike moves ({speed}). The unit clears a fault only at standstill: stop first, motor too.',
  'faults.speed_unknown':
    'Whether the bike stands still is not known. The unit clears a fault only at standstill.',
  'faults.cleared': 'Cleared: {names}.',
  'faults.forgotten': 'The faults that were over are cleared.',
  'faults.not_cleared_moving':
    'Not cleared, because the bike moves: {names}. Stop and clear again.',
  'faults.not_cleared_cause':
    'Not cleared: {names}. The bike stands still, so the cause is still there, or has been gone ' +
    'for less than a second. Mend it, wait a second, clear again. Switching off and on clears it ' +
    'too, but it comes back as long as its cause is there.',
  'faults.not_asked': 'Nothing was cleared:',
  'faults.stop_clear': 'Stop the simulated rider and clear',
  'faults.stopping': 'The simulated rider stops; the fault is cleared when the bike stands still.',

  'live.recorder': 'Recorder: {saved} rows saved, {lost} lost',
  'live.recorder_waiting': ', {waiting} waiting',

  'outcome.unchanged': 'The unit has what it had before.',
  'outcome.changed':
    'The answer was lost, but the unit was asked again: it has the change.',
  'outcome.unknown':
    'Whether the unit has the change is not known. It is shown as soon as the unit answers.',

  'cannot.read_config': 'The settings of this unit cannot be read here.',
  'cannot.write_config': 'The settings of this unit can be read here, not changed.',
  'cannot.unit_trial': 'This unit takes nothing on trial: what is written stays.',
  'cannot.stream': 'This unit sends no live values.',
  'cannot.rider_torque': "This unit does not tell the rider's torque.",
  'cannot.calibrate': 'The torque sensor of this unit cannot be calibrated here.',
  'cannot.logs': 'No rides can be fetched from this unit.',
  'cannot.fuzzy_table': 'The assist of this unit follows no table. These are its settings.',

  'token.title': "Needs the maker's token",
  'token.factory': "The factory's own: it needs the maker's token.",
  'token.step_ask': 'Ask the unit for a challenge, with the button below. That writes nothing.',
  'token.step_hand': 'Hand the challenge to the maker, as text or as a file.',
  'token.step_paste': 'Paste the token that comes back. The change is written then, all of it.',
  'token.without': 'Without a token: keep there what the unit has, and write the rest.',
  'token.no_key':
    "This unit carries no maker's key, so no token can be made for it and nobody can change " +
    'this, here or elsewhere. Its maker can give it a key; a simulated unit is given one when it ' +
    'is started. Until then keep there what the unit has, and write the rest.',
  'token.put_back': 'Keep there what the unit has',
  'token.ask': 'Ask the unit for a challenge',
  'token.change': 'Change…',
  'token.change_of': 'Change {name}',
}

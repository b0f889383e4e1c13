// English: the page where a table is edited.
export const enTune = {
  'tune.tables': 'Which of the two tables',
  'tune.table_first': 'First table',
  'tune.table_second': 'Second table',
  'tune.used_by': 'Used by {modes}',
  'tune.used_by_none': 'No mode uses it',
  'tune.tab_changed': 'changed, not yet in the unit',
  'tune.shared': 'Both tables share the speed and torque rate peaks.',
  'tune.live_elsewhere': 'the bike runs the other table now',
  'tune.assist_ends': 'In the unit, assist ends at {speed}, as set.',
  'tune.assist_ends_market':
    'In the unit, assist ends at {speed}: the market, {market}, allows no more, whatever is set.',
  'tune.show': 'Colour the rules by',
  'tune.show_gain': 'Gain',
  'tune.show_change': 'Change',
  'tune.show_ridden': 'Where ridden',
  'tune.rules': 'Rules',
  'tune.surface': 'Gain surface',
  'tune.sets': 'Peaks of the sets',
  'tune.heatmap': 'Map',
  'tune.view': 'View of the surface',
  'tune.changed': 'Changed, not yet in the unit',
  'tune.factory': "the factory's; changes only with the maker's token",
  'tune.now': 'now {value}',
  'tune.peaks': 'Peaks of {name}',
  'tune.live_gain': 'gain now {gain}',
  'tune.preview_waits': 'The surface waits until every value is possible.',
  'tune.surface_summary': "Gain {least} to {most}, from the unit's own law",
  'tune.grid_label': 'Gain label for each speed (rows) and torque rate (columns)',
  'tune.cell': '{label} {gain}, gain at speed {speed} and torque rate {rate}',
  'tune.cell_changed':
    '{label} {gain}, gain at speed {speed} and torque rate {rate}; changed from {old}',
  'tune.strip': 'Set the chosen rules',
  'tune.step_down': 'One label down',
  'tune.step_up': 'One label up',
  'tune.restore': 'As in the unit',
  'tune.chosen': 'Chosen: {speed}, torque rate {rate}, {label}. Tap another cell to choose it.',
  'tune.chosen_changed': 'Chosen: {speed}, torque rate {rate}, {label}; in the unit {old}.',
  'tune.chosen_many': 'Chosen: {count} rules.',
  'tune.paste_not_labels':
    'Nothing pasted: only the labels NB, NS, ZO, PS, PB or the numbers 1 to 5 go into ' +
    'the rules.',
  'tune.paste_too_large':
    'Nothing pasted: the text has more rows or columns than there are from this cell on.',

  'tune.use_corner': 'time',
  'tune.use_share': '{share} % of the assisted time',
  'tune.use_never': 'never reached',
  'tune.use_hatched': 'Hatched: never reached.',
  'tune.use_here': 'Ridden here: {share} % of the assisted time, {time}, {energy}.',
  'tune.use_energy_unknown': 'motor energy not known',
  'tune.use_here_never': 'Never reached in {rides}.',
  'tune.use_here_unknown': 'Ridden here: —',
  'tune.use_rides_one': 'your last ride',
  'tune.use_rides_many': 'your last {count} rides',
  'tune.use_right':
    'Columns right of {rate} acted {share} % of the assisted time in {rides}: changes there are ' +
    'hardly felt.',
  'tune.use_right_never':
    'Columns right of {rate} never acted in {rides}: changes there are not felt.',
  'tune.use_all': 'Every column acted {share} % of the assisted time or more in {rides}.',
  'tune.use_others_one': 'One more ride says nothing about this table.',
  'tune.use_others_many': '{count} more rides say nothing about this table.',
  'tune.use_no_ride':
    'Which cells you ride is shown here after a ride: ride with Spindle connected, or fetch a ' +
    'ride from the unit.',
  'tune.use_unassisted':
    'Nothing in {rides} was assisted by this table: ride in a mode that uses it.',
  'tune.use_lacking':
    'Nothing in {rides} tells where in the table you were: torque rate or mode is missing. A ' +
    'ride recorded from this unit has them.',
  'tune.use_looking': 'Looking through your rides…',
  'tune.use_trouble': 'Your rides could not be looked through: {reason}',
}

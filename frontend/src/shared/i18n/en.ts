// English: the words of the pages. What the unit speaks of (parameters, channels) is in en_unit.ts,
// rides are in en_rides.ts, how things stand (faults) in en_state.ts.
import { enBike } from './en_bike'
import { enRides } from './en_rides'
import { enState } from './en_state'
import { enTune } from './en_tune'
import { enUnit } from './en_unit'

export const en = {
  ...enUnit,
  ...enRides,
  ...enState,
  ...enTune,
  ...enBike,
  'app.choose_unit': 'Choose a unit',
  'app.dismiss': 'Dismiss',
  'app.loading': 'Loading…',
  'app.more': 'More',
  'app.nav': 'Pages',
  'app.last_seen': 'Last seen {time}',
  'app.read_only': 'read-only',
  'app.answers': 'answers in {ms} ms',
  'app.skip': 'Skip to the page',
  'app.unknown': 'There is no page at this address.',
  'page.bike': 'Bike',
  'page.connect': 'Connect a unit',
  'page.live': 'Live',
  'page.tune': 'Tune',
  'page.try': 'Try on a ride',
  'page.why': 'Why',
  'page.library': 'Library',
  'page.rides': 'Rides',
  'page.ride': 'Ride',
  'page.compare': 'Two rides compared',
  'page.sensor': 'Calibrate',
  'page.service': 'Service',
  'page.settings': 'Settings',
  'page.unknown': 'Not found',
  'nav.group_bike': 'This bike',
  'nav.group_riding': 'Riding',
  'nav.group_workshop': 'Workshop',
  'tab.tune': 'Table',
  'tab.tune_short': 'Table',
  'page.modes': 'Modes and limits',
  'tab.modes': 'Modes and limits',
  'tab.modes_short': 'Modes',
  'tab.try': 'Try on a ride',
  'tab.try_short': 'Try',
  'tab.why': 'Why',
  'tab.why_short': 'Why',
  'tab.library': 'Library',
  'tab.library_short': 'Library',

  'state.connecting': 'Connecting',
  'state.ready': 'Connected',
  'state.read_only': 'Read only',
  'state.lost': 'Lost',
  'state.closed': 'Closed',
  'state.unreachable': 'Offline',
  'state.none': 'No unit',
  'modes.title': 'Five modes',
  'modes.keys':
    'Arrows move · Enter edits · Esc leaves · Ctrl+D copies to the right · Ctrl+Z undoes · a ' +
    'dash: this law has no such setting',
  'modes.share': '{share} % of the allowed range',
  'banner.unreachable':
    "Spindle's server does not answer. Values on this page are old. Trying again every " +
    'second.',
  'banner.connecting': 'Connecting to the unit. {reason}',
  'banner.read_only': 'The unit can be read but not changed. {reason}',
  'banner.lost':
    'The link to the unit is lost; it comes back by itself when the unit does. {reason}',
  'banner.closed': 'The link to the unit is closed. {reason}',
  'no_unit.title': 'No drive unit is connected',
  'no_unit.text':
    'This page shows a connected unit. Connect one, or add a simulated one to look ' + 'around.',

  'bike.last_ride': 'Last ride',
  'bike.all_rides': 'All rides',
  'bike.no_ride': 'No ride yet. A ride is recorded by itself when the bike moves.',
  'unit.simulated': 'Simulated',
  'unit.serial': 'Serial number',
  'unit.model': 'Model',
  'unit.firmware': 'Firmware',
  'unit.hardware': 'Hardware revision',
  'unit.protocol': 'Protocol',
  'unit.config': 'Configuration',
  'unit.generation': 'generation {generation}',
  'unit.no_faults': 'No active faults',
  'unit.unknown': 'The unit has not said yet who it is.',
  'link.title': 'Link',
  'link.state': 'State',
  'link.reason': 'Why',
  'link.url': 'Address',
  'link.change': 'Change unit…',
  'link.counters': 'Link counters',
  'health.title': 'Health of the link',
  'health.whole': 'Healthy: every frame the unit built has arrived',
  'health.link': '{lost} frames were lost on the link',
  'health.unit': '{dropped} frames were dropped by the unit',
  'health.both': '{lost} frames were lost on the link, {dropped} dropped by the unit',
  'health.sum':
    'Built {built} = received {received} + lost on the link {lost} + dropped by the unit {dropped}',
  'health.link_advice':
    'Lost on the link: damaged on the way, or sent while nothing listened. Check plug and cable.',
  'health.unit_advice':
    'Dropped by the unit: the line was full. Fewer channels or a faster line help.',
  'health.none': 'No frame of the live stream has come yet.',
  'simulation.title': 'Simulation',
  'simulation.explain':
    'A simulated rider on a simulated road. A real drive unit has no such panel.',
  'simulation.runs': '{scenario} · {time}',
  'simulation.free': 'no scenario runs',
  'simulation.none': 'none',
  'simulation.scenario': 'Scenario',
  'simulation.rider': 'Rider',
  'simulation.mode': 'Assist mode',
  'simulation.speed_factor': 'Speed of time',
  'simulation.torque': 'Rider torque',
  'simulation.grade': 'Grade of the road',
  'simulation.ground': 'Ground under the tyres',
  'simulation.ambient': 'Air temperature',
  'simulation.brake': 'Brake held',
  'simulation.walk_button': 'Walk button held',
  'ground.rails': 'the tyre never slips',
  'ground.dry': 'dry road',
  'ground.wet': 'wet road',
  'ground.leaves': 'wet leaves',
  'ground.ice': 'ice',
  'simulation.rotor_link': 'Rotor link: {good} words good, {bad} damaged, {lost} lost',
  'simulation.books': 'Energy books: {error} % off',
  'simulation.not_consistent': 'Not energy consistent',
  'broken.title': 'What is broken',
  'broken.torque_sensor': 'Torque sensor',
  'broken.speed_sensor': 'Speed sensor',
  'broken.sound': 'sound',
  'broken.stuck': 'stuck',
  'broken.open_high': 'open, at the upper end',
  'broken.open_low': 'open, at the lower end',
  'broken.drifting': 'drifting',
  'broken.lost': 'magnet lost',
  'broken.link_lost': 'Link of the rotor lost',
  'broken.motor_hall': "Motor's position sensor broken",
  'broken.battery_cut': 'Battery switched off',
  'broken.motor_warmer_k': 'Motor warmer by',
  'broken.controller_warmer_k': 'Controller warmer by',
  'rider.off': 'not pedalling',
  'rider.constant': 'constant torque',
  'rider.legs': 'two legs, two strokes a turn',

  'live.flowing': 'Live',
  'live.waiting': 'Waiting for data',
  'live.stale': 'No data for {age} s: the values below are old',
  'live.gaps': 'Gaps: {gaps}, rows lost: {rows}',

  'rider_row.speed_kmh': 'Speed',
  'rider_row.rider_power_w': 'Rider power',
  'rider_row.motor_power_w': 'Motor power',
  'rider_row.battery_soc_pct': 'Battery',
  'rider_row.range_km': 'Range',

  'group.assist': 'Assist modes and ramps',
  'group.limits': 'Limits',
  'group.market': 'Market',
  'group.drivetrain': 'Drivetrain',
  'lint.title': 'Checks of the table',
  'lint.clean': 'Nothing to complain about.',
  'lint.errors': 'Error',
  'lint.warnings': 'Warning',
  'lint.notes': 'Note',
  'lint.cell': 'row {row}, column {column}',
  'lint.row': 'row {row}',
  'lint.column': 'column {column}',
  'lint.mode': 'mode {mode}',
  'lint.modes': 'all modes',
  'lint.point': 'at {speed}, torque rate {rate}',
  'lint.rate': 'at torque rate {rate}',

  'draft.same': 'Same as in the unit',
  'draft.unsaved': '{count} changed, not yet in the unit',
  'draft.undo': 'Undo',
  'draft.redo': 'Redo',
  'draft.discard': 'Discard',
  'draft.review': 'Review and write…',
  'review.title': 'Review before writing to {name}',
  'review.what': 'What',
  'review.old': 'In the unit',
  'review.new': 'New',
  'review.range': 'Allowed',
  'review.rule': 'Rule at {speed}, torque rate {rate}',
  'review.second_rule': 'Second table: rule at {speed}, torque rate {rate}',
  'review.nothing': 'Nothing differs from the unit.',
  'review.reason': 'Reason (kept with the revision)',
  'review.reason_hint': 'for instance: softer start on wet climbs',
  'review.back': 'Back to editing',
  'review.write': 'Write to the unit',
  'review.writing': 'Writing…',
  'review.verified':
    'Written and read back, field by field: verified ({count} changed), generation ' +
    '{generation}.',
  'review.undo': 'Undo',
  'review.undo_reason': 'Undo of the last change',
  'review.undone': 'Undone: the old values are back and verified, generation {generation}.',
  'review.not_undone': 'Not undone.',
  'review.stop_undo': 'Stop the simulated rider and undo',
  'review.stop_write': 'Stop the simulated rider, write, let the rider go on',
  'review.stopping':
    'The simulated rider stops; the change is written as soon as the bike stands still.',
  'review.moving':
    'Nothing was written: the wheel or the motor turns. A new configuration is taken ' +
    'only at standstill, so that assist cannot change under the rider. Stop the bike and ' +
    'write again.',
  'review.conflict':
    'Nothing was written: somebody else changed the unit in the meantime. The column "In ' +
    'the unit" now shows what it has; look again, then write.',
  'review.refused': 'Nothing was written:',
  'review.silent': 'Nothing was written, because the unit does not answer:',
  'review.unknown':
    'It is not known whether the change was written. Once the unit answers, the column "In the ' +
    'unit" says what it has:',
  'review.changed':
    'It is written: the answer was lost, but the unit was asked again and has the change, as the ' +
    'column "In the unit" shows.',
  'review.differs': 'What the unit holds now is not what was meant:',
  'review.not_connected':
    'The unit is not connected, so nothing can be written. Your edits are kept.',

  'review.manner': 'How',
  'review.for_good': 'For good',
  'review.on_trial': 'On trial: keep it or it goes back by itself',
  'review.seconds': 'Seconds to decide (5 to 255)',
  'review.try': 'Try for {seconds} s',
  'review.trial_explain':
    'Unless you press Keep in time, the unit returns to what it has now; also after a restart ' +
    'or when it loses power.',
  'review.tried': 'Written, read back and verified. On trial now: keep it, or it goes back.',
  'review.trial_runs':
    'A change is on trial in this unit. Keep or revert it first (the bar at the top of the page).',
  'trial.title': 'On trial:',
  'trial.unknown': 'a change that was not written from here',
  'trial.left': 'goes back by itself in {time}',
  'trial.returning': 'time is up, the unit goes back…',
  'trial.keep': 'Keep',
  'trial.revert': 'Revert',
  'trial.kept': 'Kept: what was on trial is in the unit for good.',
  'trial.over': 'The trial is over',
  'trial.asked': 'Reverted as asked: the unit has again what it had before the trial.',
  'trial.time_out':
    'The time of the trial ran out and nobody kept it: the unit has again what it had before.',
  'trial.restart':
    'The unit was restarted or lost power during the trial: it has again what it had before.',
  'trial.unknown_end':
    'The trial is over, and the unit does not say why: it has not kept what was on trial.',

  'ratchet.known': "goes down freely, up again only with the maker's token",
  'ratchet.lowered':
    "Can be lowered freely; raising it again needs the maker's token. On trial it goes back by " +
    'itself.',
  'band.known': "from {low} to {high} without the maker's token",
  'band.left':
    "Further from the factory's value than may be set here ({low} to {high}). Measure it again; " +
    "if it is right, it needs the maker's token: the unit will ask for it.",
  'ratchet.raised': "Raising it needs the maker's token.",
  'unlock.title': 'Token of the maker',
  'unlock.explain':
    'Hand the challenge to the maker of the unit, who signs it with “spindle unlock sign”. The ' +
    'token is for this unit and exactly this change, and for one attempt.',
  'unlock.nonce': 'Number of this challenge',
  'unlock.hash': 'SHA-512 of the configuration',
  'unlock.holds': 'Holds',
  'unlock.left': 'for {time} more',
  'unlock.over': 'no longer: ask for a new challenge',
  'unlock.renew': 'Ask for a new challenge',
  'unlock.challenge': 'Challenge for the maker',
  'unlock.copy': 'Copy',
  'unlock.copied': 'The challenge is in the clipboard.',
  'unlock.save': 'Save as a file',
  'unlock.token': 'Token from the maker',
  'unlock.file': 'Token from a file…',
  'unlock.not_token': 'This is no token: it has 144 characters from 0 to 9 and a to f.',
  'unlock.write': 'Write with the token',

  'sensor.side_by_side': 'Raw counts and torque side by side',
  'sensor.parameters': 'Calibration in the unit',
  'zero.title': 'Zero',
  'zero.explain':
    'Take all load off the pedals and keep the cranks still. The mean of the last second ' +
    'becomes the proposed offset; nothing is written before you review it.',
  'zero.mean': 'Mean of the last second (counts)',
  'zero.deviation': 'Scatter (counts)',
  'zero.steady': 'steady',
  'zero.unsteady': 'not steady yet',
  'zero.turning': 'the cranks turn',
  'zero.propose': 'Zero from current reading',

  'service.faults': 'Faults',
  'service.active': 'active now',
  'service.over': 'over',
  'service.frozen': 'What the bike did then ({time} after switch-on)',
  'service.unknown': 'The unit does not answer; its faults are unknown.',
  'service.rider_reads': 'The rider reads: “{words}”',
  'severity.warning': 'Tells only; assist goes on.',
  'severity.assist_off': 'No assist while it lasts.',
  'severity.latched':
    'No assist until it is cleared at standstill, or the bike is switched off and on.',
  'service.revisions': 'Changes of the configuration',
  'service.no_revisions': 'Nothing was changed from here yet.',
  'service.when': 'When',
  'service.generation': 'Generation',
  'service.what': 'What',
  'service.why': 'Why',

  'settings.language': 'Language',
  'settings.language_not_fetched':
    'The words of that language could not be fetched. Is the server running?',
  'settings.theme': 'Appearance',
  'settings.units': 'Units',
  'settings.author': 'Your name',
  'settings.author_note':
    'Kept with your changes, as stated: nobody signs in yet. ' +
    'Empty: the name the server runs under.',
  'settings.units_note': 'Only what is shown changes; the unit and the files keep SI units.',
  'settings.server': 'This Spindle',
  'settings.version': 'Version',
  'settings.keeps': 'Keeping records',
  'settings.keeps_ok': 'everything that is to be kept is kept',
  'settings.keeps_degraded': 'not everything can be saved now: see the message above',
  'settings.keeps_unknown': 'not known: the server does not answer',
  'settings.rows': '{saved} rows saved since it started, {waiting} waiting, {lost} lost',
  'settings.api': 'Description of the API',
  'theme.system': 'As the system',
  'theme.light': 'Light',
  'theme.dark': 'Dark',
  'units.metric': 'km/h, Nm, °C',
  'units.imperial': 'mph, lbf·ft, °F',
  'help.title': 'Help',
  'help.what': 'What is this?',
  'keys.title': 'Keyboard',
  'keys.go':
    '? lists these keys. g, then b Bike, l Live, t Tune, c Calibrate, s Service, r Rides.',
  'keys.bike': 'Enter opens the first thing to do.',
  'keys.live':
    'M marks the moment in the ride. Space pauses the strips; then ← → move the cursor, ' +
    'Shift by 1 s.',
  'keys.rules':
    'Arrows move, Shift with arrows selects, 1 to 5 set NB to PB, + and − nudge, = levels, ' +
    '* scales, / interpolates, S smooths, Ctrl+C and Ctrl+V copy and paste as text, Delete ' +
    'restores, Ctrl+Z and Ctrl+Y undo and redo.',
  'keys.try':
    'O and C switch the lines of open and closed loop. On the road’s lines ← → move the cursor, ' +
    'Shift further; K shows km or time.',
  'keys.why': '← → move the moment, Shift by 1 s, N and P go to the next and last cut.',
  'keys.sensor': 'Space captures a reading, Backspace takes the last one back.',
  'keys.numbers': 'Numbers',
  'keys.numbers_text': 'Arrow up and down nudge; with Shift five times as far.',

  'fault.not_a_number': 'is not a number',
  'fault.not_increasing': 'must be at least {bound} above the one before',
  'fault.not_text': 'is too long',
  'fault.below_min': 'is below the least allowed value, {bound}',
  'fault.above_max': 'is above the greatest allowed value, {bound}',
}

export type Key = keyof typeof en

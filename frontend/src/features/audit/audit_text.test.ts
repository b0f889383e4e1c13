/* Goal: an event says who did what to what, and from what to what, in the reader's units. */
import en from '$messages/en/audit.json'
import { fill, Locale } from '$shared/i18n/locale.svelte'
import { Units } from '$shared/units/units.svelte'
import { expect, it } from 'vitest'
import type { AuditEvent } from './audit_server'
import { differences, sentence, unitOf, type Say } from './audit_text'

const say: Say = (key, values) => fill(en[key], values)
const locale = new Locale()
const metric = new Units(locale, 'metric')
const EVENT: AuditEvent = {
  id: 7,
  at: '2026-07-13T10:00:00Z',
  actor_kind: 'person',
  actor_name: 'Ben',
  person_id: 2,
  key_name: null,
  action: 'configuration_written',
  object_kind: 'configuration',
  object_id: '12',
  object_name: 'Blue',
  unit_key: 'ebl:A',
  bike_id: 3,
  bike_name: 'Grey',
  before: { motor_torque_nm_max: 2 },
  after: { motor_torque_nm_max: 1.5 },
  reason: 'it bucked',
  sha256: '0'.repeat(64),
}

it.each([
  [{}, 'Ben wrote configuration 12 to Blue'],
  [{ actor_name: '' }, 'Somebody wrote configuration 12 to Blue'],
  [{ actor_kind: 'key', key_name: 'bench' }, 'Ben (key bench) wrote configuration 12 to Blue'],
  [
    { actor_kind: 'server', actor_name: '', action: 'configuration_found' },
    'Spindle found configuration 12 in Blue',
  ],
  [
    { actor_kind: 'command', action: 'account_added', object_name: 'Anna' },
    'Ben (command) added the account Anna',
  ],
  [{ object_name: null }, 'Ben wrote configuration 12 to Grey'],
] as const)('%j is told as it was', (other, told) => {
  expect(sentence(say, { ...EVENT, ...(other as Partial<AuditEvent>) })).toBe(told)
})

it('tells values in the reader\'s units', () => {
  const shown = (units: Units) => {
    const [one] = differences(say, locale, units, EVENT)
    return [one?.label, one?.before, one?.after]
  }

  expect(shown(metric)).toEqual(['Largest motor torque (shaft)', '2\u00a0Nm', '1.5\u00a0Nm'])
  expect(shown(new Units(locale, 'imperial'))[2]).toBe('1.106\u00a0lbf·ft')
})

it('tells what is no number in words, and what is not there by a dash', () => {
  const after = {
    role: 'dealer',
    enabled: false,
    scopes: ['see_bikes', 'upload_files'],
    changed: ['name', 'notes'],
    owner: null,
    ride_ids: [4, 5],
    units: { speed: 'm/s' },
  }

  expect(
    differences(say, locale, metric, { before: null, after }).map((one) => [
      one.label,
      one.before,
      one.after,
    ]),
  ).toEqual([
    ['Role', '—', 'dealer'],
    ['May sign in', '—', 'no'],
    ['What for', '—', 'see_bikes, upload_files'],
    ['Changed', '—', 'name, notes'],
    ['Owner', '—', '—'],
    ['Rides', '—', '4 5'],
    ['Units', '—', '{"speed":"m/s"}'],
  ])
})

it.each([
  ['motor_torque_nm_max', 'Nm'],
  ['sensor_gain_nm_per_count', 'Nm/count'],
  ['assist_cutoff_kmh', 'km/h'],
  ['gear_ratio', ''],
  ['wheel_circumference_m', 'm'],
])('%s is in %s', (name, unit) => {
  expect(unitOf(name)).toBe(unit)
})

/* Goal: the rider's row shows what the unit told, keeps the two powers apart, and what is not known
   is a dash with its reason, never a zero. */
import type { Server } from '$shared/api/server'
import type { Dashboard } from '$shared/api/types'
import type { AppContext } from '$shared/context/app_context'
import { Locale } from '$shared/i18n/locale.svelte'
import { Units } from '$shared/units/units.svelte'
import { mount, unmount } from 'svelte'
import { afterEach, expect, it, vi } from 'vitest'
import RiderRow from './RiderRow.svelte'

const context = vi.hoisted(() => ({ now: null as unknown }))
vi.mock('$shared/context/app_context', () => ({ useAppContext: () => context.now }))

const told: Dashboard = {
  t_us: 5_000_000,
  speed_kmh: 21.46,
  acceleration_ms2: null,
  rider_power_w: 118,
  motor_power_w: 141,
  battery_soc_pct: 80,
  battery_voltage_v: 36,
  distance_km: 0.1,
  missing_s: 0,
  range_km: null,
}
let shown: ReturnType<typeof mount> | null = null

async function show(dashboard: Server['dashboard'], stale = false) {
  const locale = new Locale()
  const units = new Units(locale, 'metric')
  context.now = { locale, units, server: { dashboard } } as Partial<Omit<AppContext, 'server'>>
  document.body.innerHTML = ''
  shown = mount(RiderRow, { target: document.body, props: { id: 'a', stale } })
  const row = () => document.querySelector<HTMLElement>('[data-testid=rider-row]')
  await vi.waitFor(() => expect(row()).not.toBeNull())
  return row
}
const value = (key: string) =>
  document.querySelector(`[data-value=${key}] dd`)?.textContent?.replace(/\s+/g, ' ').trim()

afterEach(async () => {
  if (shown) await unmount(shown)
  shown = null
})

it('shows both powers beside each other and a dash for what is not known', async () => {
  await show(() => Promise.resolve(told))

  await vi.waitFor(() => expect(value('speed_kmh')).toBe('21.5 km/h'))
  expect(value('rider_power_w')).toBe('118 W')
  expect(value('motor_power_w')).toBe('141 W')
  expect(value('acceleration_ms2')).toBe('—')
  expect(value('range_km')).toBe('— known once some road and battery are used')
})

it('is old as soon as the link is', async () => {
  const row = await show(() => Promise.resolve(told), true)

  expect(row()?.dataset.stale).toBe('true')
})

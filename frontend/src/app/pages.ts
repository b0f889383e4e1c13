// One line per screen. Each loads when it is first opened, so that charts cost nothing before.
import type { Component } from 'svelte'
import type { PageName } from './router.svelte'

type Loader = () => Promise<{ default: Component<{ id: string }> }>
type Screen = { default: Component<Record<string, never>> | Component<{ id: string }> }

const screen = (load: () => Promise<Screen>): Loader => load as Loader

export const loaders: Record<PageName, Loader> = {
  audit: screen(() => import('../features/audit/AuditPage.svelte')),
  bike: screen(() => import('../features/units/bike/BikePage.svelte')),
  compare: screen(() => import('../features/rides/comparison/ComparePage.svelte')),
  connect: screen(() => import('../features/units/connect/ConnectPage.svelte')),
  fleet: screen(() => import('../features/bikes/FleetPage.svelte')),
  fleet_bike: screen(() => import('../features/bikes/RegisterPage.svelte')),
  live: screen(() => import('../features/units/live/LivePage.svelte')),
  tune: screen(() => import('../features/tuning/table/TunePage.svelte')),
  modes: screen(() => import('../features/tuning/modes/ModesPage.svelte')),
  try: screen(() => import('../features/rides/replay/ReplayPage.svelte')),
  why: screen(() => import('../features/tuning/why/WhyPage.svelte')),
  library: screen(() => import('../features/tuning/library/LibraryPage.svelte')),
  rides: screen(() => import('../features/rides/RidesPage.svelte')),
  ride: screen(() => import('../features/rides/ride/RidePage.svelte')),
  sensor: screen(() => import('../features/calibration/SensorPage.svelte')),
  service: screen(() => import('../features/service/ServicePage.svelte')),
  settings: screen(() => import('../features/settings/SettingsPage.svelte')),
  visit: screen(() => import('../features/service/VisitPage.svelte')),
  unknown: screen(() => import('./UnknownPage.svelte')),
}

// Composition root: builds everything once and mounts the application.
import { Author } from '$shared/api/author.svelte'
import { openHttp } from '$shared/api/client'
import { here } from '$shared/api/place'
import { Server } from '$shared/api/server'
import { SIGN_IN, isAlone } from '$shared/api/signed_in'
import { Drafts } from '$shared/config/drafts'
import type { AppContext } from '$shared/context/app_context'
import { DeviceWatch } from '$shared/context/device_watch.svelte'
import { FirstSteps } from '$shared/context/first_steps.svelte'
import { HealthWatch } from '$shared/context/health_watch.svelte'
import { Help } from '$shared/context/help.svelte'
import { Permits } from '$shared/context/permits'
import { Rider } from '$shared/context/rider.svelte'
import { Locale } from '$shared/i18n/locale.svelte'
import '$shared/ui/base.css'
import { Foot } from '$shared/ui/foot.svelte'
import { Heading } from '$shared/ui/heading.svelte'
import { Theme } from '$shared/ui/theme.svelte'
import { Toasts } from '$shared/ui/toasts.svelte'
import { Units } from '$shared/units/units.svelte'
import { mount } from 'svelte'
import App from './App.svelte'
import { BuildWatch } from './build_watch.svelte'
import { readPreferences } from './preferences'
import { Router } from './router.svelte'

const chosen = readPreferences()
const theme = new Theme(chosen.theme)
theme.apply()
const author = new Author(chosen.author)
const server: Server = new Server(openHttp(author, (device_id) => devices.keyOf(device_id)))
const locale = new Locale()
const permits = new Permits()
// A page of its own: without a sign-in no request of the other pages is allowed.
const alone = isAlone(here())
await Promise.all([
  // Words that cannot be fetched leave the pages in English: that is better than none.
  locale.speak(chosen.language).catch(() => undefined),
  alone ? undefined : permits.load(server.http),
])
const router = new Router(permits.has('see_bikes') ? 'bike' : 'rides')
const devices = new DeviceWatch(server, chosen.device_id)
const health = new HealthWatch(server)
const context: AppContext = {
  server,
  permits,
  author,
  rider: new Rider(chosen.threshold_power_w, chosen.heart_rate_bpm_max),
  devices,
  health,
  locale,
  units: new Units(locale, chosen.units),
  theme,
  toasts: new Toasts(),
  foot: new Foot(),
  heading: new Heading(),
  help: new Help(),
  first_steps: new FirstSteps(chosen.first_steps),
  go: router.go,
}
const target = document.getElementById('app')
target?.replaceChildren() // what it says while nothing was loaded
if (target && !alone) {
  router.start()
  if (permits.has('see_bikes')) devices.start()
  else devices.startWithout()
  if (permits.has('see_server')) health.start()
  const file = new URL(import.meta.url).pathname.split('/').at(-1)
  const build = new BuildWatch(file ?? '')
  build.start()
  mount(App, { target, props: { context, build, drafts: new Drafts(server), router } })
}
if (alone && here() !== SIGN_IN) {
  void import('../features/bikes/pairing/pair').then(({ show }) => show(server.http, locale))
} else if (alone || permits.person) {
  const { person } = permits
  void import('../features/people/sign_in').then(({ show }) => show(person, server.http, locale))
}

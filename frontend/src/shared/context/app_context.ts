// What every page may use, made once by app/main.ts and handed down through Svelte's context.
import { createContext } from 'svelte'
import type { Author } from '../api/author.svelte'
import type { Server } from '../api/server'
import type { Locale } from '../i18n/locale.svelte'
import type { Foot } from '../ui/foot.svelte'
import type { Heading } from '../ui/heading.svelte'
import type { Theme } from '../ui/theme.svelte'
import type { Toasts } from '../ui/toasts.svelte'
import type { Units } from '../units/units.svelte'
import type { DeviceWatch } from './device_watch.svelte'
import type { FirstSteps } from './first_steps.svelte'
import type { HealthWatch } from './health_watch.svelte'
import type { Help } from './help.svelte'
import type { Permits } from './permits'
import type { Rider } from './rider.svelte'

export interface AppContext {
  server: Server
  permits: Permits
  author: Author
  rider: Rider
  devices: DeviceWatch
  health: HealthWatch
  locale: Locale
  units: Units
  theme: Theme
  toasts: Toasts
  foot: Foot
  heading: Heading
  help: Help
  first_steps: FirstSteps
  /** Goes to another page of this application. */
  go: (path: string) => void
}

export const [useAppContext, provideAppContext] = createContext<AppContext>()

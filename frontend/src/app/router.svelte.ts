// The address bar is the state: which page, which ride.
import type { Permission } from '$shared/api/people_server'
import { here, placeOf } from '$shared/api/place'
import { isAlone } from '$shared/api/signed_in'

/** The pages of Tune in the order of their tabs. The first is at tune, another at tune/NAME. */
export const TUNE_PAGES = ['tune', 'modes', 'try', 'why', 'library'] as const
export type TunePage = (typeof TUNE_PAGES)[number]

export type PageName =
  | TunePage
  | 'audit'
  | 'bike'
  | 'compare'
  | 'connect'
  | 'fleet'
  | 'fleet_bike'
  | 'live'
  | 'rides'
  | 'ride'
  | 'sensor'
  | 'service'
  | 'settings'
  | 'visit'
  | 'unknown'

export interface Route {
  page: PageName
  id: string
}

const pages: Record<string, PageName> = {
  audit: 'audit',
  connect: 'connect',
  fleet: 'fleet',
  live: 'live',
  rides: 'rides',
  sensor: 'sensor',
  service: 'service',
  settings: 'settings',
}

/** Pages of one thing, by what stands before its number. */
const PAGES_OF_ONE: Record<string, PageName> = {
  fleet: 'fleet_bike',
  rides: 'ride',
  visits: 'visit',
}

export function isOfTune(page: PageName): page is TunePage {
  return (TUNE_PAGES as readonly PageName[]).includes(page)
}

const PAGES_OF_A_UNIT: readonly PageName[] = ['bike', 'live', 'sensor', 'service']

/** Whether what a page shows and holds is of the unit that is there. */
export function isOfUnit(page: PageName): boolean {
  return isOfTune(page) || PAGES_OF_A_UNIT.includes(page)
}

/** What a page needs; null for one that everybody has. */
export function neededFor(page: PageName): Permission | null {
  if (page === 'audit') return 'see_audit'
  return isOfUnit(page) || page === 'connect' ? 'see_bikes' : null
}

export function tunePath(page: TunePage): string {
  return page === TUNE_PAGES[0] ? page : `${TUNE_PAGES[0]}/${page}`
}

/** home: the page at the empty address. */
export function readRoute(place: string, home: PageName = 'bike'): Route {
  const [first = '', second = '', ...rest] = place.split('/')
  if (place.replace(/\/$/, '') === 'rides/compare') return { page: 'compare', id: '' }
  const of_one = PAGES_OF_ONE[first]
  if (second && rest.length === 0 && of_one) return { page: of_one, id: decodeURIComponent(second) }
  if (place === '') return { page: home, id: '' }
  const tune = TUNE_PAGES.find((page) => tunePath(page) === place.replace(/\/$/, ''))
  if (tune) return { page: tune, id: '' }
  return { page: second ? 'unknown' : (pages[first] ?? 'unknown'), id: '' }
}

export class Router {
  route = $state.raw<Route>({ page: 'unknown', id: '' })

  constructor(private readonly home: PageName) {
    this.read()
  }

  start(): void {
    window.addEventListener('popstate', () => this.read())
    document.addEventListener('click', (event) => this.follow(event))
  }

  readonly go = (path: string): void => {
    history.pushState(null, '', path)
    this.read()
    const main = document.getElementById('main')
    main?.scrollTo(0, 0)
    main?.parentElement?.scrollTo(0, 0) // which scrolls in a low window
  }

  private read(): void {
    this.route = readRoute(here(), this.home)
  }

  // Links stay plain links: new tab, copy address and middle click work as everywhere.
  private follow(event: MouseEvent): void {
    const link = (event.target as Element | null)?.closest('a')
    const plain = event.button === 0 && !event.metaKey && !event.ctrlKey && !event.shiftKey
    if (!link || !plain || event.defaultPrevented || link.target || link.hasAttribute('download')) {
      return
    }
    const place = placeOf(link.pathname)
    if (link.origin !== location.origin || place.startsWith('api/') || isAlone(place)) return
    event.preventDefault()
    this.go(link.pathname + link.search)
  }
}

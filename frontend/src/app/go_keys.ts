// Keys that work on every page: `?` lists the keys, `g` and a letter goes to a page.

const PLACES: Readonly<Record<string, string>> = {
  b: '.',
  l: 'live',
  t: 'tune',
  c: 'sensor',
  s: 'service',
  r: 'rides',
  f: 'fleet',
}
const WAIT_MS = 1500

/** Follows keys; a `g` counts for a while, and nothing counts in what is being typed. */
export class GoKeys {
  private begun_ms = -Infinity

  constructor(
    private readonly go: (path: string) => void,
    private readonly list: () => void,
    private readonly has: (path: string) => boolean = () => true,
  ) {}

  key(event: KeyboardEvent, now_ms: number): void {
    const typing = (event.target as Element | null)?.closest?.('input, select, textarea, dialog')
    if (typing || event.ctrlKey || event.metaKey || event.altKey) return
    const path = now_ms - this.begun_ms < WAIT_MS ? PLACES[event.key] : undefined
    this.begun_ms = event.key === 'g' ? now_ms : -Infinity
    if (path !== undefined && this.has(path)) this.go(path)
    else if (event.key === '?') this.list()
    else return
    event.preventDefault()
  }
}

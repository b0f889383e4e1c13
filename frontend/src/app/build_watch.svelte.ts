// Whether these pages are still the server's: an update leaves an open page with parts that are
// gone.
import { PollWhileVisible } from '$shared/context/poll_while_visible'

const PERIOD_MS = 60_000

export class BuildWatch {
  /** The server has other pages now. */
  is_old = $state(false)
  /** A part of this page could not be fetched, whatever the reason. */
  lacks_part = $state(false)
  private readonly polling = new PollWhileVisible(() => this.check(), PERIOD_MS)

  /** entry: the file that these pages began with, whose name carries a hash of all of them. */
  constructor(
    private readonly entry: string,
    private readonly first_page = import.meta.env.BASE_URL,
  ) {}

  start(): void {
    window.addEventListener('vite:preloadError', () => this.lacked())
    this.polling.start()
  }

  lacked(): void {
    this.lacks_part = true
    void this.check()
  }

  /** Checks which pages the server has. An answer that is not ours, such as a proxy's, is ignored.
      */
  async check(): Promise<void> {
    if (this.is_old) return
    try {
      const answer = await fetch(this.first_page, {
        cache: 'no-cache',
        headers: { accept: 'text/html' },
      })
      const page = answer.ok ? await answer.text() : ''
      const [, entry] = /src="[^"]*?([\w.-]+\.[jt]s)"/.exec(page) ?? []
      this.is_old = page.includes('id="app"') && entry !== undefined && entry !== this.entry
    } catch {
      // The server does not answer: the banner of the connection says so.
    }
  }
}

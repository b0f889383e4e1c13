// The first steps of a new user: pages to have been on, until all are or they are hidden.

export const FIRST_STEPS = ['bike', 'live', 'tune', 'try', 'sensor'] as const
export type FirstStep = (typeof FIRST_STEPS)[number]

const isStep = (page: unknown): page is FirstStep => FIRST_STEPS.includes(page as FirstStep)

export class FirstSteps {
  done = $state.raw<readonly FirstStep[]>([])
  put_away = $state(false)

  /** `stored` is what `toJSON` returned before; anything unreadable counts as nothing done. */
  constructor(stored: unknown) {
    const { done, put_away } = (stored ?? {}) as { done?: unknown; put_away?: unknown }
    if (Array.isArray(done)) this.done = FIRST_STEPS.filter((step) => done.includes(step))
    this.put_away = put_away === true
  }

  readonly shown = $derived(!this.put_away && this.done.length < FIRST_STEPS.length)

  visit(page: string): void {
    if (isStep(page) && !this.done.includes(page)) this.done = [...this.done, page]
  }

  again(): void {
    this.done = []
    this.put_away = false
  }

  toJSON(): { done: readonly FirstStep[]; put_away: boolean } {
    return { done: this.done, put_away: this.put_away }
  }
}

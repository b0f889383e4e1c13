// Short messages that say what happened, with at most a few on screen.

export interface ToastAction {
  label: string
  run: () => void
}

export interface Toast {
  id: number
  kind: 'ok' | 'bad'
  text: string
  actions: ToastAction[]
}

const TOASTS_MAX = 3 // more than that hides the page they talk about
const OK_MS = 12_000 // long enough to reach for Undo

export class Toasts {
  items = $state.raw<Toast[]>([])
  private next_id = 1
  private readonly timers: Record<number, ReturnType<typeof setTimeout>> = {}

  /** Shows a message. A failure stays until dismissed; success leaves by itself. */
  say(kind: Toast['kind'], text: string, actions: ToastAction[] = []): void {
    const id = this.next_id++
    const others = this.items.filter((toast) => toast.kind !== kind || toast.text !== text)
    this.items = fewest([...others, { id, kind, text, actions }])
    this.release(id)
  }

  dismiss(id: number): void {
    this.hold(id)
    this.items = this.items.filter((toast) => toast.id !== id)
  }

  /** Keeps a message while the pointer is over it or the focus is in it. */
  hold(id: number): void {
    clearTimeout(this.timers[id])
  }

  /** Lets it leave again, after as long as a new one. */
  release(id: number): void {
    this.hold(id)
    if (this.items.find((toast) => toast.id === id)?.kind !== 'ok') return
    this.timers[id] = setTimeout(() => this.dismiss(id), OK_MS)
  }
}

/** As many as there is room for: the oldest good news goes first, then the oldest failure. */
function fewest(toasts: Toast[]): Toast[] {
  if (toasts.length <= TOASTS_MAX) return toasts
  const oldest_ok = toasts.findIndex((toast) => toast.kind === 'ok')
  return fewest(toasts.toSpliced(Math.max(0, oldest_ok), 1))
}

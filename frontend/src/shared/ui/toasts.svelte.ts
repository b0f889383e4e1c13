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

  /** Shows a message. A failure stays until dismissed; success leaves by itself. */
  say(kind: Toast['kind'], text: string, actions: ToastAction[] = []): void {
    const id = this.next_id++
    this.items = [...this.items, { id, kind, text, actions }].slice(-TOASTS_MAX)
    if (kind === 'ok') setTimeout(() => this.dismiss(id), OK_MS)
  }

  dismiss(id: number): void {
    this.items = this.items.filter((toast) => toast.id !== id)
  }
}

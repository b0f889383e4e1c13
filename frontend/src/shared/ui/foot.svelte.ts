// The foot of the window: messages, and below them the one action bar of the page. It stands in the
// page's own flow, so that neither lies over the other, and nothing is under it that cannot be
// scrolled out.
import type { Snippet } from 'svelte'

export class Foot {
  bar = $state.raw<Snippet | null>(null)

  /** Shows an action bar; what comes back takes it away, unless another has come. */
  show(bar: Snippet): () => void {
    this.bar = bar
    return () => {
      if (this.bar === bar) this.bar = null
    }
  }
}

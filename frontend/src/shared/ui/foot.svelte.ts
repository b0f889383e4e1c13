// The foot of the window: messages, and below them the one action bar of the page. It stands in the
// page's own flow, so that neither lies over the other, and nothing is under it that cannot be
// scrolled out.
import { untrack, type Snippet } from 'svelte'

export class Foot {
  private bars = $state.raw<Snippet[]>([])

  /** The one that came last. */
  get bar(): Snippet | null {
    return this.bars.at(-1) ?? null
  }

  /** Shows an action bar; what comes back takes it away, and the one before is seen again.
   *  beneath: it is seen only while there is no other, whichever came first. */
  show(bar: Snippet, beneath = false): () => void {
    untrack(() => (this.bars = beneath ? [bar, ...this.bars] : [...this.bars, bar]))
    return () => untrack(() => (this.bars = this.bars.filter((one) => one !== bar)))
  }
}

// The heading of the window: the page's own words where it has some, such as the name of a ride.
import type { Snippet } from 'svelte'

export class Heading {
  words = $state.raw<Snippet | null>(null)

  /** Shows a page's words instead of its kind; what comes back takes them away again. */
  show(words: Snippet): () => void {
    this.words = words
    return () => {
      if (this.words === words) this.words = null
    }
  }
}

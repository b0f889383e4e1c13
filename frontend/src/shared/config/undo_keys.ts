// Ctrl+Z and Ctrl+Y of a page that edits, wherever the focus is but in what is being typed.
import type { ConfigDraft } from './config_draft.svelte'

/** onmoved: undo or redo moved these parameters. */
export function undoKeys(
  event: KeyboardEvent,
  draft: ConfigDraft,
  onmoved?: (names: string[]) => void,
): void {
  const typing = (event.target as Element).closest('input, textarea, dialog')
  if (typing || !(event.ctrlKey || event.metaKey)) return
  const key = event.key.toLowerCase()
  const redo = key === 'y' || (key === 'z' && event.shiftKey)
  if (!redo && key !== 'z') return
  event.preventDefault()
  const names = redo ? draft.redo() : draft.undo()
  onmoved?.(names)
}

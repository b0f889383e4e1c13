// The draft of a page for the unit that is chosen, kept up to date with that unit.
import { untrack } from 'svelte'
import type { Refusal } from '../api/client'
import { useAppContext } from '../context/app_context'
import { can } from '../device/capabilities'
import { refusalText } from '../i18n/refusal_text'
import type { ConfigDraft } from './config_draft.svelte'
import { useDrafts } from './drafts'

export interface PageDraft {
  /** Null while there is no unit. */
  readonly draft: ConfigDraft | null
  /** Why the unit's configuration could not be read; null if it could. */
  readonly problem: string | null
}

/** Follows the chosen unit; called while a component is made. */
export function pageDraft(page: string): PageDraft {
  const { devices, locale } = useAppContext()
  const drafts = useDrafts()
  let problem = $state<string | null>(null)
  const device = $derived(devices.current)
  const readable = $derived(devices.ready && can(device, 'read_config'))
  const generation = $derived(device?.config?.generation)
  const crc32 = $derived(device?.config?.crc32)
  const draft = $derived(device ? drafts.of(device, page) : null)

  // Of a unit that is away, what it was last known to have.
  const recalled = $derived(devices.away && !devices.unreachable && can(device, 'read_config'))

  $effect(() => {
    if (!recalled || !draft) return
    untrack(() => draft.recall()).then(
      () => (problem = null),
      (error: Refusal) => (problem = refusalText(locale, error)),
    )
  })
  $effect(() => {
    if (!readable || !draft) return
    const stamped = generation !== undefined && crc32 !== undefined
    const stamp = stamped ? { generation, crc32 } : null
    // A change of the draft must not trigger another read.
    untrack(() => draft.follow(stamp)).then(
      () => (problem = null),
      (error: Refusal) => (problem = refusalText(locale, error)),
    )
  })
  return {
    get draft() {
      return draft
    },
    get problem() {
      return problem
    },
  }
}

// What a channel is called where nothing beside it says of what it is.
import type { Locale } from './locale.svelte'

export function channelName(name: string, { lookup }: Locale): string {
  const own = lookup(`channel.${name}`, name.replaceAll('_', ' '))
  return lookup(`column.${name}`, lookup(`trace.${name}`, own))
}

// What a page is called: the workshop's fleet is what a rider calls their bikes.
import type { Permits } from '$shared/context/permits'
import type { PageName } from './router.svelte'

export function titleOf(page: PageName, permits: Permits): PageName | 'my_bikes' {
  return page === 'fleet' && permits.own_only ? 'my_bikes' : page
}

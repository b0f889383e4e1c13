// What to look at and what to do for each cause: fetched with the search alone.
import en from '$messages/en/guide.json'
import { catalogue } from '$shared/i18n/catalogue.svelte'

export const guide_words = await catalogue(en, () => import('$messages/zh/guide.json'))

import en from '$messages/en/pairing.json'
import { catalogue } from '$shared/i18n/catalogue.svelte'

export const words = await catalogue(en, () => import('$messages/zh/pairing.json'))

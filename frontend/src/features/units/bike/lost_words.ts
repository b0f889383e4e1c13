import en from '$messages/en/lost.json'
import { catalogue } from '$shared/i18n/catalogue.svelte'

export const words = await catalogue(en, () => import('$messages/zh/lost.json'))

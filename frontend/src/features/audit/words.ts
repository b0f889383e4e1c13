import en from '$messages/en/audit.json'
import { catalogue } from '$shared/i18n/catalogue.svelte'

export const words = await catalogue(en, () => import('$messages/zh/audit.json'))

import en from '$messages/en/live.json'
import { catalogue } from '$shared/i18n/catalogue.svelte'

export const words = await catalogue(en, () => import('$messages/zh/live.json'))
export type Key = keyof typeof en

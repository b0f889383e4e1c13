import en from '$messages/en/compare.json'
import { catalogue } from '$shared/i18n/catalogue.svelte'

export const words = await catalogue(en, () => import('$messages/zh/compare.json'))
export type Key = keyof typeof en

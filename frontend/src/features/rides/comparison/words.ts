import en from '$messages/en/comparison.json'
import { catalogue } from '$shared/i18n/catalogue.svelte'

export const words = await catalogue(en, () => import('$messages/zh/comparison.json'))
export type Key = keyof typeof en

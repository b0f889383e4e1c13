import en from '$messages/en/service.json'
import { catalogue } from '$shared/i18n/catalogue.svelte'

export const words = await catalogue(en, () => import('$messages/zh/service.json'))
export type Key = keyof typeof en
export type Say = ReturnType<typeof words>

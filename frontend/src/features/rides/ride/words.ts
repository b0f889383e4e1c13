import en from '$messages/en/ride.json'
import { catalogue } from '$shared/i18n/catalogue.svelte'

export const words = await catalogue(en, () => import('$messages/zh/ride.json'))
export type Key = keyof typeof en
export type Say = ReturnType<typeof words>

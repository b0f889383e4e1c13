import en from '$messages/en/doubts.json'
import { catalogue } from '$shared/i18n/catalogue.svelte'

export const words = await catalogue(en, () => import('$messages/zh/doubts.json'))
export type Say = ReturnType<typeof words>

import en from '$messages/en/try.json'
import { catalogue } from '$shared/i18n/catalogue.svelte'

export const words = await catalogue(en, () => import('$messages/zh/try.json'))
export type Say = ReturnType<typeof words>

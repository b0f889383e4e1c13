import en from '$messages/en/library.json'
import { catalogue } from '$shared/i18n/catalogue.svelte'

export const words = await catalogue(en, () => import('$messages/zh/library.json'))
export type Say = ReturnType<typeof words>

import en from '$messages/en/from_file.json'
import { catalogue } from '$shared/i18n/catalogue.svelte'

export const words = await catalogue(en, () => import('$messages/zh/from_file.json'))
export type Key = keyof typeof en
export type Say = ReturnType<typeof words>

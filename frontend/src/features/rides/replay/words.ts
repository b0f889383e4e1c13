import en from '$messages/en/replay.json'
import { catalogue } from '$shared/i18n/catalogue.svelte'

export const words = await catalogue(en, () => import('$messages/zh/replay.json'))
export type Say = ReturnType<typeof words>

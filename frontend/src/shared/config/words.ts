import en from '$messages/en/configuration.json'
import { catalogue } from '../i18n/catalogue.svelte'

export const words = await catalogue(en, () => import('$messages/zh/configuration.json'))
export type Say = ReturnType<typeof words>

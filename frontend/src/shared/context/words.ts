import en from '$messages/en/keys.json'
import { catalogue } from '../i18n/catalogue.svelte'

export const words = await catalogue(en, () => import('$messages/zh/keys.json'))

import en from '$messages/en/draft.json'
import { catalogue } from '../i18n/catalogue.svelte'

export const words = await catalogue(en, () => import('$messages/zh/draft.json'))

import en from '$messages/en/fault_moment.json'
import { catalogue } from '../i18n/catalogue.svelte'

export const words = await catalogue(en, () => import('$messages/zh/fault_moment.json'))

import en from '$messages/en/sign_in.json'
import { catalogue } from '$shared/i18n/catalogue.svelte'

export const words = await catalogue(en, () => import('$messages/zh/sign_in.json'))

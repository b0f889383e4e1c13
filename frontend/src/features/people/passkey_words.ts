import en from '$messages/en/passkeys.json'
import { catalogue } from '$shared/i18n/catalogue.svelte'

export const words = await catalogue(en, () => import('$messages/zh/passkeys.json'))

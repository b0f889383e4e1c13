import en from '$messages/en/table_surface.json'
import { catalogue } from '$shared/i18n/catalogue.svelte'

export const words = await catalogue(en, () => import('$messages/zh/table_surface.json'))

import en from '$messages/en/limit_proof.json'
import { catalogue } from '../i18n/catalogue.svelte'

export const words = await catalogue(en, () => import('$messages/zh/limit_proof.json'))
export type Key = keyof typeof en

import en from '$messages/en/calibration_drift.json'
import { catalogue } from '$shared/i18n/catalogue.svelte'

export const words = await catalogue(en, () => import('$messages/zh/calibration_drift.json'))

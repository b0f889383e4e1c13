import calibrate from '$messages/en/calibration.json'
import figures from '$messages/en/calibration_figures.json'
import reported from '$messages/en/calibration_findings.json'
import { catalogue } from '$shared/i18n/catalogue.svelte'

export const words = await catalogue(calibrate, () => import('$messages/zh/calibration.json'))

/** What each figure of a calibration means. */
export const meanings = await catalogue(
  figures,
  () => import('$messages/zh/calibration_figures.json'),
)
export type Figure = keyof typeof figures

/** What the server reports with a code: its own sentence in English, unless that has other units
    for some readers. */
export const findings = await catalogue(
  reported,
  () => import('$messages/zh/calibration_findings.json'),
)
export const isFinding = (code: string): code is keyof typeof reported => code in reported

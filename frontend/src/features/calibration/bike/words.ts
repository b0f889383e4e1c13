import en from '$messages/en/calibration_bike.json'
import { catalogue } from '$shared/i18n/catalogue.svelte'

type Of<Prefix extends string> = keyof typeof en extends infer Key
  ? Key extends `${Prefix}${infer Rest}`
    ? Rest
    : never
  : never

export const isReason = (code: string): code is Of<'why_'> => `why_${code}` in en
export const isCause = (code: string): code is Of<'cause_'> => `cause_${code}` in en

export const words = await catalogue(en, () => import('$messages/zh/calibration_bike.json'))

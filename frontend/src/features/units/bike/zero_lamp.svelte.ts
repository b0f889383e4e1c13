// What the rides show of the torque sensor's zero, for its lamp. It comes after the page: the first
// one need not carry it.
import en from '$messages/en/bike.json'
import type { SensorDrift } from '$shared/api/types'
import type { AppContext } from '$shared/context/app_context'
import { catalogue } from '$shared/i18n/catalogue.svelte'

const words = await catalogue(en, () => import('$messages/zh/bike.json'))

export interface ZeroLamp {
  level: NonNullable<SensorDrift['level']>
  number: () => string
  note: () => string
}

/** Null where no ride shows it since the last calibration, or there is no answer. */
export async function zeroLamp(
  { server, locale, units }: AppContext,
  device_id: string,
  signal: AbortSignal,
): Promise<ZeroLamp | null> {
  const say = words(locale)
  const { level, latest } = await server.sensorDrift(device_id, signal, 0)
  if (level === null || latest === null) return null
  return {
    level,
    number: () => units.text(latest.zero_nm, 'Nm', 2),
    note: () => say(level, { when: locale.instant(latest.started_at) }),
  }
}

// How a unit is called where there is room for one line.
import type { Device } from '../api/types'
import type { Locale } from '../i18n/locale.svelte'

/** "Simulated 0042", "Commuter" or "/dev/ttyUSB0": its serial number once known, else its owner's
    name for it, else where it is. */
export function deviceName(device: Device, locale: Locale): string {
  const serial = device.identity?.serial_number
  const tail = serial ? serial.slice(-6) : (device.name ?? device.url)
  return device.kind === 'simulated' ? `${locale.t('unit.simulated')} ${tail}` : tail
}

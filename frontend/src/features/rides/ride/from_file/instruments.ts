// The devices that recorded a ride, in words.
import type { Ride } from '$shared/api/types'
import en from '$messages/en/from_file.json'
import type { Key, Say } from './words'

type Instrument = Ride['instruments'][number]

/** Maker and product as the file has them; a product that is a number alone says nothing. */
export function deviceName({ maker, product }: Instrument): string {
  const named = product !== null && !/^\d+$/.test(product) ? product : null
  return [maker?.replaceAll('_', ' '), named].filter((one) => one).join(' ')
}

export function deviceLine({ serial_number, battery_status }: Instrument, say: Say): string {
  const has_battery = battery_status !== null && !battery_status.startsWith('status_')
  return [
    serial_number === null ? '' : say('serial', { number: serial_number }),
    has_battery ? say('battery', { state: wordOf(say, 'state', battery_status) }) : '',
  ]
    .filter((one) => one !== '')
    .join(' · ')
}

/** A word of the file: ours where there is one, else its own. */
export function wordOf(say: Say, of: 'kind' | 'sport' | 'state', word: string): string {
  const key = `${of}_${word.toLowerCase()}`
  return key in en ? say(key as Key) : word.replaceAll('_', ' ')
}

/** What recorded a ride: by its file, else the unit it came from; '' where unknown. */
export function recorderOf({ instruments, device }: Ride): string {
  const recorder = instruments.find(({ kind }) => kind === 'recorder')
  return (recorder && deviceName(recorder)) || (device.device_serial ?? '')
}

// What is typed about a bike, and what of it is another than before.
import type { Bike, BikeChange } from '$shared/api/bike_server'

export interface BikeText {
  name: string
  model: string
  frame_number: string
  battery: string
  /** NaN where it cannot be read. */
  mileage_km: number | null
}

/** What a bike's fields show; empty where nobody wrote anything down. */
export function textOf(bike: Bike | null): BikeText {
  return {
    name: bike?.name ?? '',
    model: bike?.model ?? '',
    frame_number: bike?.frame_number ?? '',
    battery: bike?.battery ?? '',
    mileage_km: bike?.mileage_km ?? null,
  }
}

/** Only what differs: an unchanged mileage keeps its date. An emptied field takes away what it
    said. */
export function changeOf(bike: Bike, text: BikeText): BikeChange {
  const before = textOf(bike)
  const changed = Object.entries(text).filter(
    ([field, value]) => value !== before[field as keyof BikeText],
  )
  return Object.fromEntries(changed.map(([field, value]) => [field, value === '' ? null : value]))
}

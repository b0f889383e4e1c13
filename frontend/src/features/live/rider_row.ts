// What the rider's row shows of the dashboard, in order.
import type { Dashboard } from '$shared/api/types'

export interface RiderValue {
  key: Exclude<keyof Dashboard, 't_us' | 'battery_voltage_v' | 'missing_s'>
  unit: string
  digits: number
}

export const riderRow: RiderValue[] = [
  { key: 'speed_kmh', unit: 'km/h', digits: 1 },
  { key: 'acceleration_ms2', unit: 'm/s²', digits: 2 },
  { key: 'rider_power_w', unit: 'W', digits: 0 },
  { key: 'motor_power_w', unit: 'W', digits: 0 },
  { key: 'distance_km', unit: 'km', digits: 2 },
  { key: 'battery_soc_pct', unit: '%', digits: 0 },
  { key: 'range_km', unit: 'km', digits: 0 },
]

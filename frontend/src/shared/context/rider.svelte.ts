// What zones are shares of: set by the rider in Settings, stored in this browser; null until then.
export class Rider {
  threshold_power_w = $state<number | null>(null)
  heart_rate_bpm_max = $state<number | null>(null)

  constructor(threshold_power_w: number | null, heart_rate_bpm_max: number | null) {
    this.threshold_power_w = threshold_power_w
    this.heart_rate_bpm_max = heart_rate_bpm_max
  }
}

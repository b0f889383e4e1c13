// Where in the table the bike was in the last seconds.
export interface Place {
  speed_kmh: number
  torque_rate: number
}

const TRAIL_MS = 10_000

export class Trail {
  places = $state.raw<Place[]>([])
  private seen: (Place & { at_ms: number })[] = []

  /** The bike is at a place now; null: unknown, or it runs by the other table. */
  note(place: Place | null, now_ms: number): void {
    const last = this.seen[this.seen.length - 1]
    if (!place) this.seen = []
    else if (last?.speed_kmh === place.speed_kmh && last.torque_rate === place.torque_rate) {
      last.at_ms = now_ms // a bike that stands adds nothing
    } else this.seen.push({ ...place, at_ms: now_ms })
    this.seen = this.seen.filter(({ at_ms }) => now_ms - at_ms <= TRAIL_MS)
    this.places = [...this.seen]
  }
}

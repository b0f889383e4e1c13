// The assist modes of a ride: which was chosen when, and the line style of each.
import type { RideEvent } from '$shared/api/types'

export interface ModeSpan {
  from_s: number
  to_s: number
  mode: number
}

export interface ModeStyle {
  token: string
  /** In the drawing's pixels; empty for a solid line. */
  dash: string
  width: number
}

const styles: ModeStyle[] = [
  { token: 'line-strong', dash: '', width: 1.5 },
  { token: 'speed', dash: '1 5', width: 3 },
  { token: 'cadence', dash: '9 5', width: 3 },
  { token: 'motor', dash: '', width: 3 },
  { token: 'rider', dash: '', width: 5 },
]
const unknown: ModeStyle = { token: 'accent', dash: '', width: 3 }

/** A slot's line; null where no mode is known. */
export function modeStyle(mode: number | null): ModeStyle {
  return mode === null ? unknown : (styles[mode] ?? { ...unknown, dash: '2 2' })
}

/** Each mode from its choice to the next; nothing before the first. */
export function modeSpans(events: readonly RideEvent[], end_s: number): ModeSpan[] {
  const chosen = events.filter(({ kind }) => kind === 'assist_mode')
  return chosen
    .map(({ t_s, value }, i) => ({ from_s: t_s, to_s: chosen[i + 1]?.t_s ?? end_s, mode: value }))
    .filter(({ from_s, to_s }) => to_s > from_s)
}

export function modeAt(spans: readonly ModeSpan[], t_s: number): number | null {
  return spans.find(({ from_s, to_s }) => t_s >= from_s && t_s < to_s)?.mode ?? null
}

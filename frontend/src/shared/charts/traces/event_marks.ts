// What happened on a ride, above its traces: one mark for each event, and a line down through the
// rows. The list below the traces says the same in words.
import type { RideEvent } from '$shared/api/types'
import type { Theme } from '$shared/ui/theme.svelte'

const MARK_ROW_PX = 14
const LINES_MAX = 40 // more would hide the curves; the marks are all there

type Kind = RideEvent['kind']
const styles: Record<Kind, { symbol: string; token: string }> = {
  fault_set: { symbol: 'triangle-down', token: 'bad' },
  fault_cleared: { symbol: 'circle-open', token: 'ok' },
  settings: { symbol: 'square', token: 'accent' },
  mark: { symbol: 'star', token: 'accent' },
  clock_set: { symbol: 'hourglass', token: 'ink-2' },
  assist_mode: { symbol: 'diamond', token: 'ink-2' },
}
const kinds = Object.keys(styles) as Kind[] // the worst first

/** An event with its sentence. */
export interface MarkedEvent extends RideEvent {
  text: string
}

export interface EventWords {
  kind: (kind: Kind) => string
  moment: (t_s: number, step_s?: number) => string
  /** Where a moment lies on the axis. */
  at: (t_s: number) => number
}

/** One series of marks for each kind of event there is, on the axis `yaxis`. */
export function markData(
  events: MarkedEvent[],
  yaxis: string,
  theme: Theme,
  words: EventWords,
): object[] {
  // The last is drawn on top: a fault is never hidden behind a mode.
  return kinds.toReversed().flatMap((kind) => {
    const those = events.filter((event) => event.kind === kind)
    if (those.length === 0) return []
    const { symbol, token } = styles[kind]
    return {
      type: 'scatter',
      mode: 'markers',
      name: words.kind(kind),
      x: those.map((event) => words.at(event.t_s)),
      y: those.map(() => 0.5),
      yaxis,
      marker: { symbol, size: 10, color: theme.colour(token), line: { width: 1.5 } },
      cliponaxis: false,
      text: those.map((event) => `${event.text}<br>${words.moment(event.t_s)}`),
      hovertemplate: '%{text}<extra></extra>',
    }
  })
}

/** The marks' own axis at the top; `height` of the whole figure in pixels. */
export function markAxis(height: number): object {
  return { domain: [1 - MARK_ROW_PX / height, 1], range: [0, 1], fixedrange: true, visible: false }
}

/** Lines through the rows below `top` (0 to 1); faults before modes where there are too many. */
export function markLines(
  events: MarkedEvent[],
  top: number,
  theme: Theme,
  words: EventWords,
): object[] {
  const rank = (event: MarkedEvent) => kinds.indexOf(event.kind)
  const worst = [...events].sort((a, b) => rank(a) - rank(b)).slice(0, LINES_MAX)
  return worst.map(({ kind, t_s }) => ({
    type: 'line',
    xref: 'x',
    yref: 'paper',
    x0: words.at(t_s),
    x1: words.at(t_s),
    y0: 0,
    y1: top,
    line: { color: theme.colour(styles[kind].token), width: 1, dash: 'dot' },
    layer: 'below',
  }))
}

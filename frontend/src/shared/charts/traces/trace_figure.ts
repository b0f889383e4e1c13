// A ride's series as one Plotly figure: rows above each other, one time axis, gaps left open.
import type { Series } from '$shared/api/series'
import type { Theme } from '$shared/ui/theme.svelte'
import type { Units } from '$shared/units/units.svelte'
import { markAxis, markLines, type EventWords, type MarkedEvent } from './event_marks'
import { plotStyle } from './plotly'
import { axisTicks } from './trace_axis'
import type { TraceWindow } from './trace_window.svelte'
import {
  binLine,
  MARKS_PX,
  type Span,
  type TraceLine,
  type TraceRow,
} from './trace_line'

export interface FigureWords extends EventWords {
  row: (key: string) => string
  events: string
  channel: (name: string) => string
}

export interface Frame {
  rows: TraceRow[]
  gaps: Span[]
  filled: Span[]
  events: MarkedEvent[]
  cuts: Span[]
  /** Size of the plot in pixels. */
  width: number
  height: number
}

/** Beside the plot, in pixels. */
export const MARGIN_PX = { l: 44, r: 10, t: 18, b: 26 }
const ROW_GAP_PX = 26 // room for a row's title
const SWATCH = { thin: '▬', broad: '▬', dashed: '╍' }

/** The lines of a series, each in the row that shows its channel. */
export function traceData(
  series: Series,
  rows: TraceRow[],
  theme: Theme,
  units: Units,
  words: FigureWords,
): object[] {
  const moments = hoverMoments(series, words)
  return rows.flatMap((row, i) =>
    row.lines.flatMap((line) => {
      const channel = series.channels.find((c) => c.name === line.channel)
      if (!channel) return []
      const { x_first = series.t_first_s, x_last = series.t_last_s } = series
      const { x, y } = binLine(x_first, x_last, channel.min, channel.max)
      return {
        type: 'scatter',
        mode: 'lines',
        name: fullName(line, words),
        x,
        y: y.map((value) => units.show(value, row.unit)),
        yaxis: axisName(i),
        line: { color: theme.colour(line.token), simplify: false, ...stroke(line) },
        connectgaps: false,
        customdata: moments,
        hovertemplate: `${units.label(row.unit)} %{y:.4~g}<br>%{customdata}`,
      }
    }),
  )
}

function stroke({ style }: TraceLine): { width: number; dash?: string } {
  if (style === 'dashed') return { width: 1.6, dash: '5px,3px' }
  return { width: style === 'broad' ? 3 : 1.4 }
}

/** The part of the layout that a zoom changes; a figure is not built anew for it. */
export function windowLayout(view: TraceWindow, width: number, units: Units) {
  const { low, high } = view.span
  const ticks = axisTicks(view.axis, low, high, Math.max(3, width / 110), units)
  return {
    'xaxis.range': [low, high],
    'xaxis.tickvals': ticks.at,
    'xaxis.ticktext': ticks.text,
  }
}

export function axisName(i: number): string {
  return i === 0 ? 'y' : `y${i + 1}`
}

/** The channel's name; the line's own where it has none, as one of two rides side by side. */
function fullName({ channel, name = channel }: TraceLine, words: FigureWords): string {
  const full = words.channel(channel)
  return full === channel ? words.channel(name) : full
}

function hoverMoments(series: Series, { moment }: EventWords): string[] {
  const step = (series.to_s - series.from_s) / 2000
  const same = series.kind === 'rows'
  return Array.from(series.t_first_s).flatMap((first, i) => {
    const text = moment(first, step)
    return same ? [text] : [text, moment(series.t_last_s[i] ?? first, step)]
  })
}

/** Rows above each other with one time axis; `windowLayout` says which time. */
export function traceLayout(
  frame: Frame,
  theme: Theme,
  units: Units,
  words: FigureWords,
): Record<string, unknown> {
  const { base, axis, font } = plotStyle(theme)
  const count = frame.rows.length
  const gap = ROW_GAP_PX / frame.height
  const head = frame.events.length > 0 ? MARKS_PX / frame.height : 0
  const height = (1 - head - gap * (count - 1)) / count
  const top = (i: number) => 1 - head - i * (height + gap)
  const rows = frame.rows.map((_, i) => [
    layoutName(i),
    {
      ...axis,
      domain: [Math.max(0, top(i) - height), top(i)],
      fixedrange: true,
      nticks: 4,
      rangemode: 'tozero',
      ticklabelposition: 'outside',
      ticklabeloverflow: 'allow', // else every label is measured anew at every zoom
    },
  ])
  return {
    ...base,
    width: frame.width,
    height: frame.height,
    ...Object.fromEntries(rows),
    ...(head > 0 ? { [layoutName(count)]: markAxis(frame.height) } : {}),
    margin: MARGIN_PX,
    dragmode: false,
    hovermode: 'closest',
    hoverdistance: 30,
    xaxis: {
      ...axis,
      anchor: axisName(count - 1),
      fixedrange: true,
      tickmode: 'array',
      showspikes: true,
      spikemode: 'across',
      spikethickness: 1,
      spikecolor: theme.colour('line-strong'),
    },
    shapes: [
      ...frame.gaps.map((span) => spanShape(span, theme.colour('line'), 0.35, words)),
      ...frame.filled.map((span) => spanShape(span, theme.colour('accent-soft'), 0.6, words)),
      ...frame.cuts.map((span) => spanShape(span, theme.colour('warn'), 0.16, words)),
      ...markLines(frame.events, 1 - head, theme, words),
    ],
    annotations: [
      ...frame.rows.map((row, i) => title(rowTitle(row, units, words, theme), top(i))),
      ...(head > 0 ? [title(`<b>${words.events}</b>`, 1)] : []),
    ].map((text) => ({ ...text, font: { ...font, color: theme.colour('ink') } })),
  }
}

function layoutName(i: number): string {
  return i === 0 ? 'yaxis' : `yaxis${i + 1}`
}

function title(text: string, y: number): object {
  const place = { xref: 'paper', yref: 'paper', x: 0, y, xanchor: 'left', yanchor: 'bottom' }
  return { text, ...place, showarrow: false }
}

function rowTitle(row: TraceRow, units: Units, words: FigureWords, theme: Theme): string {
  const unit = row.unit ? ` ${units.label(row.unit)}` : ''
  const keys = row.lines.map((line) => {
    const mark = SWATCH[line.style ?? 'thin']
    const swatch = `<span style="color:${theme.colour(line.token)}">${mark}</span>`
    return `${swatch} ${words.channel(line.name ?? line.channel)}`
  })
  return row.lines.length > 1 || row.lines[0]?.style
    ? `<b>${words.row(row.key)}</b>${unit}  ${keys.join('  ')}`
    : `<b>${words.row(row.key)}</b>${unit}`
}

function spanShape(span: Span, fillcolor: string, opacity: number, { at }: EventWords): object {
  const [x0, x1] = [at(span.from_s), at(span.to_s)]
  return {
    type: 'rect',
    xref: 'x',
    yref: 'paper',
    x0,
    x1,
    y0: 0,
    y1: 1,
    fillcolor,
    opacity,
    // A stretch in which the bike stood has no width on the way: a line stands for it.
    line: { width: x0 === x1 ? 2 : 0, color: fillcolor },
    layer: 'below',
  }
}

/** Where the title of each row begins, in pixels from the top of a figure. */
export function titleTops(rows: number, height: number, marked: boolean): number[] {
  const within = height - MARGIN_PX.t - MARGIN_PX.b
  const gap = ROW_GAP_PX / height
  const head = marked ? MARKS_PX / height : 0
  const each = (1 - head - gap * (rows - 1)) / rows
  return Array.from({ length: rows }, (_, i) => MARGIN_PX.t + (head + i * (each + gap)) * within)
}

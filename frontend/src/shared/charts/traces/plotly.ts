// The door to Plotly, which draws the traces of a ride: its configuration, and a chunk of its own.
import type { Language } from '$shared/i18n/locale.svelte'
import type { Theme } from '$shared/ui/theme.svelte'

/** Nothing leaves this machine, there is no advertisement, and zooming explains itself in our
    words. */
export function plotConfig(language: Language): object {
  return {
    showSendToCloud: false,
    plotlyServerURL: '',
    displaylogo: false,
    showTips: false,
    displayModeBar: false,
    responsive: false,
    scrollZoom: false,
    doubleClick: false,
    // Clips stay references within the page. Otherwise they are absolute where a page has a <base>,
    // and lost once its address changes.
    _exportedPlot: true,
    locale: language === 'zh' ? 'zh-CN' : 'en',
  }
}

export function loadLines() {
  return import('./plotly_lines')
}

export async function loadTraceChart() {
  return (await loadLines()).TraceChart
}

/** Colours and type of a chart, from the style sheet. */
export function plotStyle(theme: Theme): { font: object; axis: object; base: object } {
  const ink = theme.colour('ink-2')
  const font = {
    family: '-apple-system, "Segoe UI", Roboto, "Noto Sans", "Noto Sans CJK SC", sans-serif',
    size: 12,
    color: ink,
  }
  const axis = {
    gridcolor: theme.colour('grid'),
    linecolor: theme.colour('line'),
    zerolinecolor: theme.colour('line'),
    zeroline: false,
    tickfont: font,
  }
  const base = {
    paper_bgcolor: 'rgba(0,0,0,0)',
    plot_bgcolor: 'rgba(0,0,0,0)',
    font,
    showlegend: false,
    hoverlabel: {
      bgcolor: theme.colour('panel'),
      bordercolor: theme.colour('line-strong'),
      font: { ...font, color: theme.colour('ink') },
    },
  }
  return { font, axis, base }
}

// Lines only, the smallest Plotly there is, and what draws a ride with it: needed together.
import core from 'plotly.js/lib/core'
import chinese from 'plotly.js/lib/locales/zh-cn'
import type { Plotly } from './plotly_types'

const plotly = core as unknown as Plotly
plotly.register(chinese)

export { default as TraceChart } from './TraceChart.svelte'
export { plotly }

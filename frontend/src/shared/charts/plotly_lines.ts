// Lines only; the smallest Plotly there is.
import core from 'plotly.js/lib/core'
import chinese from 'plotly.js/lib/locales/zh-cn'
import type { Plotly } from './plotly_types'

const plotly = core as unknown as Plotly
plotly.register(chinese)

export default plotly

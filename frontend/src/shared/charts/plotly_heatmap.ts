// Lines and heatmaps.
import heatmap from 'plotly.js/lib/heatmap'
import { plotly } from './plotly_lines'

plotly.register(heatmap)

export default plotly

// Surfaces in three dimensions, only for those who ask for one.
import surface from 'plotly.js/lib/surface'
import { plotly } from './plotly_lines'

plotly.register(surface)

export default plotly

// Parts of Plotly that come without types.
declare module 'plotly.js/lib/core'
declare module 'plotly.js/lib/heatmap'
declare module 'plotly.js/lib/surface'
declare module 'plotly.js/lib/locales/zh-cn'

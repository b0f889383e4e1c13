// Parts of Plotly that come without types.
declare module 'plotly.js/lib/core'
declare module 'plotly.js/lib/locales/zh-cn'

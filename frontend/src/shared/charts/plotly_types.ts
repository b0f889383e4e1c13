// The few functions of Plotly that we call, typed as we call them.

export interface Axis {
  range: [number, number]
  _offset: number
  _length: number
  l2p(value: number): number
}
export interface PlotNode extends HTMLElement {
  data: Record<string, unknown>[]
  layout: Record<string, unknown>
  _fullLayout: Record<string, Axis> & { width: number; height: number }
  on(event: string, handler: (change: Record<string, unknown>) => void): void
}
export interface Plotly {
  newPlot(node: HTMLElement, data: object[], layout: object, config: object): Promise<PlotNode>
  react(node: HTMLElement, data: object[], layout: object, config: object): Promise<PlotNode>
  restyle(node: HTMLElement, change: object, traces?: number[]): Promise<PlotNode>
  relayout(node: HTMLElement, change: object): Promise<PlotNode>
  purge(node: HTMLElement): void
  register(modules: unknown): void
  Plots: { resize(node: HTMLElement): Promise<void> }
}

// The few functions of Plotly that we call, typed as we call them.

export interface PlotNode extends HTMLElement {
  data: Record<string, unknown>[]
  layout: Record<string, unknown>
}
export interface Plotly {
  react(node: HTMLElement, data: object[], layout: object, config: object): Promise<PlotNode>
  relayout(node: HTMLElement, change: object): Promise<PlotNode>
  purge(node: HTMLElement): void
  register(modules: unknown): void
}

// The box that a surface stands in: lines on its floor and on the two walls behind, and the words
// along the edges in front.
import { roundTicks } from '$shared/charts/plot_axis'
import type { Pixel, Solid } from './solid'

interface Side {
  title: string
  low: number
  high: number
}

interface Word {
  text: string
  at: Pixel
  anchor: 'start' | 'middle' | 'end'
}

const [TICK_PX, TITLE_PX] = [14, 40] // from the edge
const LETTER_PX = 7 // of its width, at most

/** Lines and words for sides that go along x, along y and upwards. */
export function boxOf(solid: Solid, { x, y, up }: Record<'x' | 'y' | 'up', Side>) {
  const { far } = solid
  const near = { x: 1 - far.x, y: 1 - far.y }
  const ticks = ({ low, high }: Side) =>
    roundTicks(low, high, 5).map(({ value, text }) => {
      return { share: (value - low) / (high - low), text }
    })
  const lines: (readonly [Pixel, Pixel])[] = []
  for (const share of [0, 1, ...ticks(x).map((tick) => tick.share)]) {
    lines.push([solid.at(share, 0, 0), solid.at(share, 1, 0)])
    lines.push([solid.at(share, far.y, 0), solid.at(share, far.y, 1)])
  }
  for (const share of [0, 1, ...ticks(y).map((tick) => tick.share)]) {
    lines.push([solid.at(0, share, 0), solid.at(1, share, 0)])
    lines.push([solid.at(far.x, share, 0), solid.at(far.x, share, 1)])
  }
  for (const share of [0, 1, ...ticks(up).map((tick) => tick.share)]) {
    lines.push([solid.at(0, far.y, share), solid.at(1, far.y, share)])
    lines.push([solid.at(far.x, 0, share), solid.at(far.x, 1, share)])
  }
  // What stands upright is named at the left.
  const edges = [
    { x: far.x, y: near.y },
    { x: near.x, y: far.y },
  ]
  const at = (edge: { x: number; y: number }, share: number) => solid.at(edge.x, edge.y, share)
  const left = edges.sort((a, b) => at(a, 0)[0] - at(b, 0)[0])[0] ?? far
  const onX = (share: number, px: number, text: string) =>
    beyond(solid.at(share, near.y, 0), solid.at(share, 0.5, 0), px, text)
  const onY = (share: number, px: number, text: string) =>
    beyond(solid.at(near.x, share, 0), solid.at(0.5, share, 0), px, text)
  const words: Word[] = [
    ...ticks(x).map(({ share, text }) => onX(share, TICK_PX, text)),
    ...ticks(y).map(({ share, text }) => onY(share, TICK_PX, text)),
    onX(0.5, TITLE_PX, x.title),
    onY(0.5, TITLE_PX, y.title),
    ...ticks(up).map(({ share, text }): Word => {
      const [across, down] = at(left, share)
      return { text, at: [across - 6, down + 4], anchor: 'end' }
    }),
  ]
  const [across, down] = at(left, 1)
  words.push({ text: up.title, at: [Math.max(4, across - 40), down - 12], anchor: 'start' })
  return { lines, words }
}

/** A word so far beyond an edge, on the line that comes to it from the middle of the floor. */
function beyond([left, top]: Pixel, middle: Pixel, by_px: number, text: string): Word {
  const [across, down] = [left - middle[0], top - middle[1]]
  const far = Math.hypot(across, down) || 1
  const anchor = across < -far / 3 ? 'end' : across > far / 3 ? 'start' : 'middle'
  const at_px = left + (by_px * across) / far
  // Its first letters stay within a narrow drawing.
  const from_px = anchor === 'end' ? Math.max(at_px, LETTER_PX * text.length) : at_px
  return { text, at: [from_px, top + (by_px * down) / far + 4], anchor }
}

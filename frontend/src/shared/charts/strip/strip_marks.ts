// What a strip marks besides its lines: shaded stretches with their names, and a cursor.
import type uPlot from 'uplot'
import type { StripMarks, StripShade, StripSpec } from './strip_chart'

const LINE_PX = 14
const PAD_PX = 4
const DOT_PX = 3.5

/** Drawn before the lines, so that they lie on it. */
export function drawShades(
  plot: uPlot,
  spec: StripSpec,
  shades: readonly StripShade[],
  font: string,
): void {
  const { ctx, bbox } = plot
  const ratio = devicePixelRatio
  const [ground, ink] = spec.shade
  const right = bbox.left + bbox.width
  const drawn = shades
    .map(({ from_s, to_s, name }) => ({
      from: Math.max(bbox.left, plot.valToPos(from_s, 'x', true)),
      to: Math.min(right, Number.isFinite(to_s) ? plot.valToPos(to_s, 'x', true) : right),
      name,
    }))
    .filter(({ from, to }) => to > from)
  inside(plot, () => {
    ctx.lineWidth = ratio
    ctx.setLineDash([2 * ratio, 2 * ratio])
    for (const { from, to } of drawn) {
      ctx.fillStyle = ground
      ctx.fillRect(from, bbox.top, to - from, bbox.height)
      ctx.strokeStyle = ink
      for (const x of [from, to]) {
        ctx.beginPath()
        ctx.moveTo(x, bbox.top)
        ctx.lineTo(x, bbox.top + bbox.height)
        ctx.stroke()
      }
    }
    write(plot, font)
    ctx.fillStyle = ink
    let free_from = bbox.left
    for (const { from, name } of drawn) {
      const wide = ctx.measureText(name).width + 2 * PAD_PX * ratio
      const left = Math.max(bbox.left, Math.min(from, right - wide))
      if (left < free_from) continue // the list above the strips names it
      ctx.fillText(name, left + PAD_PX * ratio, bbox.top + PAD_PX * ratio)
      free_from = left + wide
    }
  })
}

/** Drawn after the lines: the moment, a dot on each line, and the value of the last one. */
export function drawCursor(
  plot: uPlot,
  spec: StripSpec,
  cursor: StripMarks['cursor'],
  font: string,
): void {
  if (cursor === null) return
  const { ctx, bbox } = plot
  const ratio = devicePixelRatio
  const [ground, ink] = spec.cursor
  const x = plot.valToPos(cursor.at_s, 'x', true)
  inside(plot, () => {
    ctx.strokeStyle = ground
    ctx.lineWidth = ratio
    ctx.beginPath()
    ctx.moveTo(x, bbox.top)
    ctx.lineTo(x, bbox.top + bbox.height)
    ctx.stroke()
    cursor.values.forEach((value, line) => {
      if (value === null) return
      ctx.fillStyle = spec.lines[line]?.colour ?? ground
      ctx.beginPath()
      ctx.arc(x, plot.valToPos(value, 'y', true), DOT_PX * ratio, 0, 2 * Math.PI)
      ctx.fill()
    })
    write(plot, font)
    const value = cursor.values[cursor.values.length - 1] ?? null
    const text = value === null ? '—' : String(Number(value.toFixed(Math.abs(value) < 2 ? 3 : 1)))
    const wide = ctx.measureText(text).width + 2 * PAD_PX * ratio
    const left = x - wide > bbox.left ? x - wide : x
    const top = bbox.top + bbox.height - (LINE_PX + PAD_PX) * ratio
    ctx.fillStyle = ground
    ctx.fillRect(left, top, wide, (LINE_PX + PAD_PX / 2) * ratio)
    ctx.fillStyle = ink
    ctx.fillText(text, left + PAD_PX * ratio, top + 2 * ratio)
  })
}

function write({ ctx }: uPlot, font: string): void {
  ctx.font = font.replace(/^\d+px/, `600 ${12 * devicePixelRatio}px`)
  ctx.textAlign = 'left'
  ctx.textBaseline = 'top'
}

/** Draws within the plot's own space and leaves the canvas as it was. */
function inside({ ctx, bbox }: uPlot, work: () => void): void {
  ctx.save()
  ctx.beginPath()
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height)
  ctx.clip()
  work()
  ctx.restore()
}

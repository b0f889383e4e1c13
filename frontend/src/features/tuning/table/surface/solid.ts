// A surface over two axes as seen from a side: where its places lie on the screen, and its cells
// from the farthest to the nearest. Seen from far away, so that equal lengths stay equal.

/** The viewpoint: turn about the vertical, and tilt; in radians. */
export interface View {
  turn: number
  tilt: number
}

export const INITIAL_VIEW: View = { turn: 0.75, tilt: 0.55 }
const [TILT_LEAST, TILT_MOST] = [0.12, 1.4]
const HEIGHT = 0.62 // of the surface, where its sides are 1

/** The view turned and tilted further. */
export function turned({ turn, tilt }: View, by: View): View {
  const raised = Math.min(TILT_MOST, Math.max(TILT_LEAST, tilt + by.tilt))
  return { turn: (turn + by.turn) % (2 * Math.PI), tilt: raised }
}

export type Pixel = readonly [left: number, top: number]

export class Solid {
  private readonly sin: number
  private readonly cos: number
  private readonly scale: number

  constructor(
    private readonly view: View,
    private readonly width: number,
    private readonly height: number,
  ) {
    this.sin = Math.sin(view.turn)
    this.cos = Math.cos(view.turn)
    // Room for the words of the axes; as large as any turn lets it be.
    const upright = Math.SQRT2 * Math.sin(view.tilt) + HEIGHT * Math.cos(view.tilt)
    this.scale = Math.max(1, Math.min((width - 110) / Math.SQRT2, (height - 76) / upright))
  }

  /** A place of the box, each of its three shares 0 to 1. As on the map, y grows towards the eye
      and x to the right while nothing is turned. */
  at(x: number, y: number, up: number): Pixel {
    const [u, v, w] = [x - 0.5, 0.5 - y, (up - 0.5) * HEIGHT]
    const across = u * this.cos - v * this.sin
    const away = u * this.sin + v * this.cos
    const raised = away * Math.sin(this.view.tilt) + w * Math.cos(this.view.tilt)
    return [this.width / 2 + this.scale * across, this.height / 2 - 8 - this.scale * raised]
  }

  /** The shares of the two sides that are farther away. */
  get far(): { x: 0 | 1; y: 0 | 1 } {
    return { x: this.sin > 0 ? 1 : 0, y: this.cos > 0 ? 0 : 1 }
  }

  /** Every cell of a grid, the farthest first: what is painted later lies in front. */
  *cells(rows: number, columns: number): Generator<readonly [row: number, column: number]> {
    const { x, y } = this.far
    for (let i = 0; i < rows - 1; i++) {
      const row = y === 1 ? rows - 2 - i : i
      for (let j = 0; j < columns - 1; j++) yield [row, x === 1 ? columns - 2 - j : j]
    }
  }
}

/** Whether a place is within a figure of any number of corners. */
export function within(corners: readonly Pixel[], [left, top]: Pixel): boolean {
  let inside = false
  corners.forEach(([x, y], i) => {
    const [before_x, before_y] = corners[(i || corners.length) - 1] ?? [x, y]
    const crosses = y > top !== before_y > top
    if (crosses && left < x + ((top - y) / (before_y - y)) * (before_x - x)) inside = !inside
  })
  return inside
}

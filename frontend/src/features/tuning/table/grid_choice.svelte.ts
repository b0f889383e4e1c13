// Which rules are chosen: one, or a block from an anchor to where the focus is.
import { blockOf, type Block, type Cell } from './table'

const STEPS: Record<string, [number, number]> = {
  ArrowUp: [-1, 0],
  ArrowDown: [1, 0],
  ArrowLeft: [0, -1],
  ArrowRight: [0, 1],
}

export class GridChoice {
  focus = $state.raw<Cell>({ row: 0, column: 0 })
  private anchor = $state.raw<Cell>({ row: 0, column: 0 })
  /** The next cell that is pressed is the other corner: for a hand without a Shift key. */
  reaching = $state(false)

  get block(): Block {
    return blockOf(this.anchor, this.focus)
  }

  get several(): boolean {
    const { top, bottom, left, right } = this.block
    return top !== bottom || left !== right
  }

  has(row: number, column: number): boolean {
    const { top, bottom, left, right } = this.block
    return row >= top && row <= bottom && column >= left && column <= right
  }

  isFocus(row: number, column: number): boolean {
    return this.focus.row === row && this.focus.column === column
  }

  /** One cell. */
  at(row: number, column: number): void {
    if (this.isFocus(row, column) && !this.several) return
    this.focus = this.anchor = { row, column }
  }

  /** As far as a cell. */
  upTo(row: number, column: number): void {
    this.focus = { row, column }
  }

  /** A cell is pressed. */
  press(row: number, column: number, further: boolean): void {
    if (further || this.reaching) this.upTo(row, column)
    else this.at(row, column)
    this.reaching = false
  }

  all(): void {
    this.anchor = { row: 0, column: 0 }
    this.focus = { row: 4, column: 4 }
  }

  /** Moves by a key; whether it is one that moves. */
  key({ key, ctrlKey, metaKey, shiftKey }: KeyboardEvent): boolean {
    const command = ctrlKey || metaKey
    const { row, column } = this.focus
    const inside = (n: number) => Math.min(4, Math.max(0, n))
    const go = (to_row: number, to_column: number) => {
      this.focus = { row: inside(to_row), column: inside(to_column) }
      if (!shiftKey) this.anchor = this.focus
      return true
    }
    const step = STEPS[key]
    if (step) return go(row + step[0], column + step[1])
    if (key === 'Home') return go(command ? 0 : row, 0)
    if (key === 'End') return go(command ? 4 : row, 4)
    if (!command || key.toLowerCase() !== 'a') return false
    this.all()
    return true
  }
}

// The rules of a fuzzy table as a grid: blocks of it, nudges, and to and from text.
import type { RuleLabel } from '$shared/api/types'
import { LABELS } from '$shared/config/parameter_text'

export type Rules = RuleLabel[][]

/** Where a value lies along increasing points, as a fractional index clamped to them. */
export function placeAmong(points: number[], value: number): number {
  const after = points.findIndex((point) => point >= value)
  if (after < 0) return points.length - 1
  if (after === 0) return 0
  const [low = 0, high = 0] = [points[after - 1], points[after]]
  return after - 1 + (value - low) / (high - low)
}

export interface Cell {
  row: number
  column: number
}

export interface Block {
  top: number
  left: number
  bottom: number
  right: number
}

export function blockOf(a: Cell, b: Cell): Block {
  return {
    top: Math.min(a.row, b.row),
    bottom: Math.max(a.row, b.row),
    left: Math.min(a.column, b.column),
    right: Math.max(a.column, b.column),
  }
}

/** The labels of a block, row by row. */
export function inBlock(rules: Rules, block: Block): RuleLabel[] {
  return rules
    .slice(block.top, block.bottom + 1)
    .flatMap((cells) => cells.slice(block.left, block.right + 1))
}

/** The rules with every cell of a block replaced. */
export function mapBlock(
  rules: Rules,
  block: Block,
  change: (label: RuleLabel, row: number, column: number) => RuleLabel,
): Rules {
  return rules.map((cells, row) =>
    cells.map((label, column) => {
      const inside =
        row >= block.top && row <= block.bottom && column >= block.left && column <= block.right
      return inside ? change(label, row, column) : label
    }),
  )
}

/** The next label up or down, stopping at the ends. */
export function nudged(label: RuleLabel, by: number): RuleLabel {
  const index = Math.min(4, Math.max(0, LABELS.indexOf(label) + by))
  return LABELS[index] ?? label
}

/** A block as tab-separated lines, as spreadsheets take it. */
export function blockText(rules: Rules, block: Block): string {
  return rules
    .slice(block.top, block.bottom + 1)
    .map((cells) => cells.slice(block.left, block.right + 1).join('\t'))
    .join('\n')
}

export type Pasted = { rules: Rules } | { problem: 'not_labels' | 'too_large' }

/** Tab-separated labels (or 1 to 5) laid into the rules from a cell on; all of it or none. */
export function pasteText(rules: Rules, at: Cell, text: string): Pasted {
  const lines = text.replace(/\s+$/, '').split(/\r?\n/)
  const labels = lines.map((line) => line.split('\t').map(labelOf))
  if (labels.some((line) => line.includes(null))) return { problem: 'not_labels' }
  const width = Math.max(...labels.map((line) => line.length))
  if (at.row + labels.length > 5 || at.column + width > 5) return { problem: 'too_large' }
  const next = rules.map((cells) => [...cells])
  labels.forEach((line, row) =>
    line.forEach((label, column) => {
      const cells = next[at.row + row]
      if (cells && label) cells[at.column + column] = label
    }),
  )
  return { rules: next }
}

function labelOf(text: string): RuleLabel | null {
  const word = text.trim().toUpperCase()
  const byNumber = /^[1-5]$/.test(word) ? LABELS[Number(word) - 1] : undefined
  return byNumber ?? LABELS.find((label) => label === word) ?? null
}

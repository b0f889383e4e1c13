// What is done to the chosen rules of a draft, by whatever hand. Each is one step of undo.
import type { RuleLabel } from '$shared/api/types'
import type { ConfigDraft } from '$shared/config/config_draft.svelte'
import { LABELS } from '$shared/config/parameter_text'
import type { TableParameters } from '$shared/config/two_tables'
import { interpolated, levelled, moved, scaled, smoothed } from './block'
import type { GridChoice } from './grid_choice.svelte'
import { blockText, inBlock, mapBlock, nudged, pasteText, type Pasted, type Rules } from './table'

const KEYS: Record<string, (edit: RuleEdit) => void> = {
  '+': (edit) => edit.nudge(1),
  '-': (edit) => edit.nudge(-1),
  _: (edit) => edit.nudge(-1),
  '=': (edit) => edit.level(),
  '/': (edit) => edit.interpolate(),
  '*': (edit) => (edit.scaling = true),
  s: (edit) => edit.smooth(),
  S: (edit) => edit.smooth(),
  Delete: (edit) => edit.restore(),
  Backspace: (edit) => edit.restore(),
}

export class RuleEdit {
  /** The dialog for a factor is open. */
  scaling = $state(false)
  /** How many rules the last sum over the chosen ones moved; null once something else was done. */
  moved = $state<number | null>(null)
  private before: string | null = null

  constructor(
    private readonly draft: () => ConfigDraft,
    private readonly names: () => TableParameters,
    readonly choice: GridChoice,
  ) {}

  get rules(): Rules {
    return this.draft().value(this.names().rules) as Rules
  }

  get base(): Rules {
    return this.draft().base(this.names().rules) as Rules
  }

  get gains(): number[] {
    return this.draft().value(this.names().gains) as number[]
  }

  gainOf(label: RuleLabel): number {
    return this.gains[LABELS.indexOf(label)] ?? NaN
  }

  get chosen(): RuleLabel[] {
    return inBlock(this.rules, this.choice.block)
  }

  /** What the unit has where the chosen rules are. */
  get unchanged(): RuleLabel[] {
    return inBlock(this.base, this.choice.block)
  }

  put(label: RuleLabel): void {
    this.change(mapBlock(this.rules, this.choice.block, () => label))
  }

  nudge(by: 1 | -1): void {
    this.change(mapBlock(this.rules, this.choice.block, (old) => nudged(old, by)))
  }

  restore(): void {
    const { base } = this
    this.change(
      mapBlock(this.rules, this.choice.block, (old, row, column) => base[row]?.[column] ?? old),
    )
  }

  level(): void {
    this.sum(levelled(this.rules, this.choice.block, this.gains))
  }

  interpolate(): void {
    this.sum(interpolated(this.rules, this.choice.block, this.gains))
  }

  smooth(): void {
    this.sum(smoothed(this.rules, this.choice.block, this.gains))
  }

  scale(factor: number): void {
    this.sum(scaled(this.rules, this.choice.block, this.gains, factor))
  }

  /** How many rules a factor would move. */
  wouldMove(factor: number): number {
    return moved(this.rules, scaled(this.rules, this.choice.block, this.gains, factor))
  }

  text(): string {
    return blockText(this.rules, this.choice.block)
  }

  /** Lays text into the rules, from the upper left of the chosen ones on; all of it or none. */
  paste(text: string): Pasted {
    const { top, left } = this.choice.block
    const pasted = pasteText(this.rules, { row: top, column: left }, text)
    if ('rules' in pasted) this.change(pasted.rules)
    return pasted
  }

  /** Whether the key was one that edits. */
  key(event: KeyboardEvent): boolean {
    const { key } = event
    // g goes to a page with the letter after it.
    const goes = this.before === 'g'
    this.before = key
    if (event.ctrlKey || event.metaKey || event.altKey || goes) return false
    const label = /^[1-5]$/.test(key) ? LABELS[Number(key) - 1] : undefined
    if (label) this.put(label)
    else if (KEYS[key]) KEYS[key](this)
    else return false
    return true
  }

  private sum(next: Rules): void {
    const count = moved(this.rules, next)
    this.change(next)
    this.moved = count
  }

  private change(next: Rules): void {
    this.draft().set(this.names().rules, next)
    this.moved = null
  }
}

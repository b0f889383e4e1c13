// Edits to a unit's configuration that live here, not in the unit, until they are written.
import { Refusal } from '../api/client'
import type { Server } from '../api/server'
import type { ConfigChange, Device, Parameter, ParameterValue } from '../api/types'
import { differing, rebased, same } from './elements'
import { storeDraft, type StoredDraft } from './stored_drafts'
import { isFactorys } from './ratchet'

/** A unit and where it is; its key is null until it is identified. */
export type UnitRef = Pick<Device, 'id' | 'url' | 'unit_key'>

export type Edits = Readonly<Record<string, ParameterValue>>

export interface DraftChange {
  parameter: Parameter
  old: ParameterValue
  value: ParameterValue
}

/** Which configuration a unit has, as the unit counts and sums it. */
export interface ConfigStamp {
  generation: number
  crc32: number
}

const HISTORY_MAX = 200

/** The draft of one page for one unit; it outlives the page, so that leaving loses nothing. An edit
    is of an element: what others change elsewhere meanwhile stays. */
export class ConfigDraft {
  parameters = $state.raw<Parameter[]>([])
  tag = $state('')
  generation = $state(0)
  loaded = $state(false)
  /** Null where the next read of the unit must be complete. */
  private crc32: number | null = null
  private writing = false
  private baseline = $state.raw<Edits>({})
  private edits = $state.raw<Edits>({})
  /** What the unit had when the first of the edits was made; empty while there is none. */
  private begun = $state.raw<Edits>({})
  /** When edits of an earlier visit were stored; null for those of this one. */
  stored_at_ms = $state<number | null>(null)
  /** Why, as it is typed for the revision. */
  private why = $state('')
  private past = $state.raw<Edits[]>([])
  private future = $state.raw<Edits[]>([])
  private gesture: string | null = null

  /** The connection that the unit was last on. */
  device_id: string
  /** Null until the unit is identified. */
  unit_key: string | null

  constructor(
    unit: Pick<UnitRef, 'id' | 'unit_key'>,
    private readonly server: Server,
    /** Under which it is stored in this browser; empty for nowhere. */
    private key = '',
    stored: StoredDraft | null = null,
  ) {
    this.device_id = unit.id
    this.unit_key = unit.unit_key
    if (!stored) return
    this.baseline = this.begun = stored.base
    this.edits = stored.edits
    this.why = stored.reason
    this.stored_at_ms = stored.at_ms
  }

  /** The unit was given a name: it is the same one, and its tags are new. */
  rename(unit_key: string, key: string): void {
    storeDraft(this.key, null)
    this.unit_key = unit_key
    this.key = key
    this.crc32 = null
    this.become(this.edits)
  }

  /** Reads the unit's configuration; edits stay and are compared with the new values. Throws
      Refusal, also where another unit is in its place. */
  async load(): Promise<void> {
    const [parameters, [config, tag]] = await Promise.all([
      this.server.parameters(this.device_id),
      this.server.config(this.device_id),
    ])
    this.take(config, config.parameters, tag)
    this.parameters = parameters
    this.loaded = true
  }

  /** Shows what the unit was last known to have, until it can be read again. It has no ETag, so
      that nothing can be written on it. */
  async recall(): Promise<void> {
    if (this.loaded) return
    const last = await this.server.lastKnown(this.device_id)
    if (this.loaded) return
    const values = Object.fromEntries(
      last.parameters.flatMap(({ name, value }) => (value === null ? [] : [[name, value]])),
    ) as Edits
    const { unit_key, generation, crc32 } = last
    this.take({ unit_key, generation: generation ?? 0, crc32: crc32 ?? 0 }, values, '')
    this.parameters = last.parameters
    this.crc32 = null
    this.loaded = true
  }

  /** Reads the configuration unless it is the one the draft has, or a write is about to return it.
      stamp: of what the unit has; null where it reports none. */
  async follow(stamp: ConfigStamp | null): Promise<void> {
    const same_one = stamp?.generation === this.generation && stamp.crc32 === this.crc32
    if (this.writing || (this.loaded && same_one)) return
    await this.load()
  }

  /** What the unit has, by its own word: the one place where that comes in. Throws Refusal for what
      another unit has. */
  private take(stamp: ConfigStamp & { unit_key: string }, parameters: Edits, tag: string): void {
    this.unit_key ??= stamp.unit_key
    if (stamp.unit_key !== this.unit_key) {
      const message = `This is for the unit ${this.unit_key}; another is there.`
      throw new Refusal(412, 'other_unit', message)
    }
    const was = this.baseline
    this.baseline = parameters
    const moved = (edits: Edits): Edits =>
      Object.fromEntries(
        Object.entries(edits)
          .map(([name, edit]) => [name, rebased(edit, was[name], parameters[name])] as const)
          .filter(([name, edit]) => !same(edit, parameters[name])),
      )
    this.past = this.past.map(moved)
    this.future = this.future.map(moved)
    this.become(moved(this.edits))
    this.generation = stamp.generation
    this.crc32 = stamp.crc32
    this.tag = tag
  }

  parameter(name: string): Parameter | undefined {
    return this.parameters.find((parameter) => parameter.name === name)
  }

  group(group: string): Parameter[] {
    return this.parameters.filter((parameter) => parameter.group === group)
  }

  /** What the unit has. */
  base(name: string): ParameterValue | undefined {
    return this.baseline[name]
  }

  /** What it had when the first of the edits was made: where that is something else, it was
      changed elsewhere meanwhile. */
  before(name: string): ParameterValue | undefined {
    return this.begun[name] ?? this.baseline[name]
  }

  /** How many elements others changed since the first of the edits was made. */
  get meanwhile(): number {
    return Object.entries(this.begun).reduce((sum, [name, was]) => {
      const now = this.baseline[name]
      return sum + (now === undefined ? 0 : differing(was, now))
    }, 0)
  }

  get reason(): string {
    return this.why
  }
  set reason(text: string) {
    this.why = text
    this.store()
  }

  /** What it would have: the edit, else what it has. */
  value(name: string): ParameterValue | undefined {
    return this.edits[name] ?? this.baseline[name]
  }

  /** The complete configuration by name, as the unit has it. */
  get bases(): Edits {
    return this.baseline
  }

  /** The same as it would be. */
  get values(): Edits {
    return { ...this.baseline, ...this.edits }
  }

  /** Changes a value. Calls of one gesture (a drag) are undone together. */
  set(name: string, value: ParameterValue, gesture: string | null = null): void {
    if (same(this.value(name), value)) return
    if (gesture === null || gesture !== this.gesture) {
      this.past = [...this.past, this.edits].slice(-HISTORY_MAX)
    }
    this.gesture = gesture
    this.future = []
    this.become(this.without(name, same(value, this.baseline[name]) ? undefined : value))
  }

  get canUndo(): boolean {
    return this.past.length > 0
  }

  get canRedo(): boolean {
    return this.future.length > 0
  }

  /** Takes the last edit back; the names of what moved. */
  undo(): string[] {
    const previous = this.past[this.past.length - 1]
    if (!previous) return []
    const names = differingNames(this.edits, previous)
    this.future = [...this.future, this.edits]
    this.past = this.past.slice(0, -1)
    this.become(previous)
    this.gesture = null
    return names
  }

  /** Makes the edit again that was taken back; the names of what moved. */
  redo(): string[] {
    const next = this.future[this.future.length - 1]
    if (!next) return []
    const names = differingNames(this.edits, next)
    this.past = [...this.past, this.edits]
    this.future = this.future.slice(0, -1)
    this.become(next)
    this.gesture = null
    return names
  }

  /** Drops every edit; undo brings them back. */
  discard(): void {
    if (this.count === 0) return
    this.past = [...this.past, this.edits]
    this.future = []
    this.become({})
  }

  /** Writes the edits in one transaction and reads back what the unit has. confirm_s: 0 for good,
      else for so many seconds on trial. token: the maker's, if a refusal requires it. Throws
      Refusal. */
  async write(reason: string, confirm_s = 0, token: string | null = null): Promise<ConfigChange> {
    const parameters = Object.fromEntries(this.changes.map((c) => [c.parameter.name, c.value]))
    const result = await this.send(parameters, reason, confirm_s, token)
    // What is left was edited while the write was on its way: it begins on what was written.
    this.past = []
    this.future = []
    this.begun = {}
    this.why = ''
    this.become(this.edits)
    return result
  }

  /** Writes the elements a change replaced, whatever others changed in them since; their other
      changes stay. Throws Refusal. */
  async takeBack(change: ConfigChange, reason: string): Promise<ConfigChange> {
    const old = () =>
      Object.fromEntries(
        change.changed.flatMap(({ name, old, new: written }) =>
          old === null ? [] : [[name, rebased(old, written, this.baseline[name])] as const],
        ),
      )
    try {
      return await this.send(old(), reason)
    } catch (error) {
      if (!(error instanceof Refusal) || error.code !== 'config_changed') throw error
      await this.load()
      return await this.send(old(), reason)
    }
  }

  private async send(
    parameters: Edits,
    reason: string,
    confirm_s = 0,
    token: string | null = null,
  ): Promise<ConfigChange> {
    this.writing = true
    try {
      const [result, tag] = await this.server.writeConfig(
        this.device_id,
        parameters,
        reason,
        this.tag,
        confirm_s,
        token,
        this.unit_key,
      )
      this.take(result, result.parameters, tag)
      // What was written from here is no concurrent change.
      if (Object.keys(this.begun).length > 0) {
        const own = Object.keys(parameters).map((name) => [name, this.baseline[name]] as const)
        this.begun = { ...this.begun, ...(Object.fromEntries(own) as Edits) }
      }
      // The factory's values move the bounds of others. The change is in the unit, whatever becomes
      // of this read.
      const moved = this.parameters.some((row) => row.name in parameters && isFactorys(row))
      if (moved) await this.load().catch(() => (this.crc32 = null))
      return result
    } finally {
      this.writing = false
    }
  }

  /** How many values differ, each element of a table counted. */
  get count(): number {
    return Object.entries(this.edits).reduce((sum, [name, value]) => {
      const old = this.baseline[name]
      return sum + (old === undefined ? 0 : differing(old, value))
    }, 0)
  }

  /** The one place where the edits become others. */
  private become(edits: Edits): void {
    const none = Object.keys(edits).length === 0
    if (none) this.begun = {}
    else if (Object.keys(this.begun).length === 0) this.begun = this.baseline
    if (none) this.stored_at_ms = null
    this.edits = edits
    this.store()
  }

  private store(): void {
    if (!this.key) return
    const { edits, begun: base, why: reason } = this
    const at_ms = this.stored_at_ms ?? Date.now()
    storeDraft(this.key, this.count > 0 ? { edits, base, reason, at_ms } : null)
  }

  private without(name: string, value: ParameterValue | undefined): Edits {
    const others = Object.entries(this.edits).filter(([other]) => other !== name)
    return Object.fromEntries(value === undefined ? others : [...others, [name, value]])
  }

  /** Every parameter that differs from what the unit has. */
  get changes(): DraftChange[] {
    return this.parameters.flatMap((parameter) => {
      const value = this.edits[parameter.name]
      const old = this.baseline[parameter.name]
      const changed = value !== undefined && old !== undefined && !same(value, old)
      return changed ? [{ parameter, old, value }] : []
    })
  }
}

function differingNames(a: Edits, b: Edits): string[] {
  return Object.keys({ ...a, ...b }).filter((name) => !same(a[name], b[name]))
}

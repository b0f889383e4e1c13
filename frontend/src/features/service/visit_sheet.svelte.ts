// The open visit of a bike as it is typed: stored by the server, and in this browser until then.
import { Refusal } from '$shared/api/client'
import type { Visit, VisitServer, VisitWords } from '$shared/api/visit_server'
import {
  EMPTY,
  edits,
  fieldsOf,
  forgetEdits,
  formerSheet,
  storedEdits,
  storeEdits,
  wordsOf,
  type SheetFields,
} from './sheet_fields'

const TYPED_MS = 700
const AGAIN_MS = 5_000

/** problem: why the last words are not on the server; they are tried again. */
export class VisitSheet {
  visit = $state.raw<Visit | null>(null)
  fields = $state<SheetFields>(structuredClone(EMPTY))
  problem = $state.raw<Refusal | null>(null)
  private base: SheetFields = structuredClone(EMPTY)
  private timer: ReturnType<typeof setTimeout> | undefined
  private saving: Promise<void> | null = null
  private left = false

  /** bike_id: null for a unit that is on no bike, whose sheet stays in this browser.
      device_id: of the unit, where it is there to be looked at. */
  constructor(
    private readonly server: VisitServer,
    readonly bike_id: number | null,
    private readonly unit_key: string,
    private readonly technician: string,
    private readonly device_id: () => string | null,
  ) {}

  /** What was typed and is not on the server yet. */
  private get unsent() {
    return edits(this.fields, this.base)
  }

  get saved(): boolean {
    return this.visit !== null && Object.keys(this.unsent).length === 0
  }

  /** Loads the open visit, with what this browser has and the server has not. */
  async load(): Promise<void> {
    const stored = { ...formerSheet(this.unit_key), ...storedEdits(this.place) }
    try {
      if (this.bike_id !== null) {
        const visits = await this.server.list(this.bike_id)
        this.take(visits.find(({ state }) => state === 'open') ?? null)
      }
    } catch (error) {
      if (!(error instanceof Refusal)) throw error
      this.problem = error
    }
    Object.assign(this.fields, stored)
    if (!this.visit) {
      // No words of anybody's: they begin no visit.
      this.base.technician = this.technician
      this.fields.technician ||= this.technician
    }
    if (Object.keys(stored).length > 0) this.edited()
  }

  /** Something was typed. */
  edited(): void {
    storeEdits(this.place, this.unsent)
    clearTimeout(this.timer)
    this.timer = setTimeout(() => void this.save(), TYPED_MS)
  }

  /** Puts a value where none is, without beginning a visit for it. */
  suggest(field: 'counter_km', value: number): void {
    if (this.fields[field] !== null) return
    this.fields[field] = value
    if (this.visit) this.edited()
    else this.base[field] = value
  }

  /** Sends what was typed; the visit then, null where there is none. */
  async save(begin = false): Promise<Visit | null> {
    while (this.saving) await this.saving
    clearTimeout(this.timer)
    const unsent = this.unsent
    if (this.bike_id === null || (!begin && Object.keys(unsent).length === 0)) return this.visit
    this.saving = this.send(this.bike_id, unsent).finally(() => (this.saving = null))
    await this.saving
    if (this.problem?.status === 0 && !this.left) {
      this.timer = setTimeout(() => void this.save(), AGAIN_MS)
    }
    return this.problem ? null : this.visit
  }

  /** Looks at the unit for the sheet, as before or after the work. Throws Refusal. */
  async look(): Promise<void> {
    const id = this.device_id()
    if (this.visit && id !== null) this.visit = await this.server.look(this.visit.id, id)
  }

  /** What another request made of the visit. */
  changed(visit: Visit): void {
    this.visit = visit
  }

  /** Closes the visit, after a last look at a unit that is there. Throws Refusal. */
  async close(): Promise<Visit | null> {
    const visit = await this.save()
    if (!visit || this.problem) return null
    if (this.device_id() !== null) await this.look()
    const closed = await this.server.close(visit.id)
    this.begin()
    return closed
  }

  /** Removes the visit that was begun by mistake. Throws Refusal. */
  async discard(): Promise<void> {
    if (this.visit) await this.server.remove(this.visit.id)
    this.begin()
  }

  /** The page is left: what is not sent goes now, and stays here if it does not arrive. */
  leave(): void {
    this.left = true
    void this.save()
  }

  private get place(): string {
    return this.bike_id === null ? this.unit_key : `bike-${this.bike_id}`
  }

  private begin(): void {
    forgetEdits(this.place)
    this.visit = null
    this.problem = null
    this.base = { ...structuredClone(EMPTY), technician: this.technician }
    this.fields = structuredClone($state.snapshot(this.base))
  }

  private async send(bike_id: number, unsent: Partial<SheetFields>): Promise<void> {
    try {
      let visit = this.visit
      if (!visit) {
        visit = await this.opened(bike_id, wordsOf(unsent))
      } else {
        visit = await this.patched(visit, wordsOf(unsent))
      }
      this.take(visit)
      this.problem = null
      if (Object.keys(this.unsent).length === 0) forgetEdits(this.place)
      else this.edited()
    } catch (error) {
      if (!(error instanceof Refusal)) throw error
      this.problem = error
    }
  }

  private async opened(bike_id: number, words: VisitWords): Promise<Visit> {
    const all = wordsOf($state.snapshot(this.fields))
    try {
      return await this.server.open(bike_id, { ...all, device_id: this.device_id() })
    } catch (error) {
      if (!(error instanceof Refusal) || error.code !== 'visit_open') throw error
      // Somebody else began it meanwhile.
      const open = (await this.server.list(bike_id)).find(({ state }) => state === 'open')
      if (!open) throw error
      return this.patched(open, words)
    }
  }

  private async patched(visit: Visit, words: VisitWords): Promise<Visit> {
    try {
      return await this.server.change(visit.id, visit.version, words)
    } catch (error) {
      if (!(error instanceof Refusal) || error.code !== 'visit_changed') throw error
      const now = await this.server.get(visit.id)
      return this.server.change(now.id, now.version, words)
    }
  }

  /** Shows a visit; what was typed meanwhile stays. */
  private take(visit: Visit | null): void {
    const typed = this.unsent
    this.visit = visit
    if (!visit) return
    const fields = fieldsOf(visit.content)
    this.base = structuredClone(fields)
    // Of what was typed only what the server does not have is another value than its.
    Object.assign(this.fields, fields, typed)
  }
}

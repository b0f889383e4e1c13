/* Goal: edits live in the draft until they are written, can be undone, and survive a concurrent
   change of the unit. */
import { afterEach, describe, expect, it, vi } from 'vitest'
import { Refusal } from '../api/client'
import type { Server } from '../api/server'
import type { Parameter, ParameterValue } from '../api/types'
import { ConfigDraft, type UnitRef } from './config_draft.svelte'
import { Drafts } from './drafts'

const parameter = (name: string): Parameter => ({
  id: 1,
  name,
  group: 'limits',
  type: 'f32',
  shape: [],
  may_be_none: false,
  of_the_unit: false,
  length: null,
  unit: 'km/h',
  min: 0,
  max: 25,
  default: 25,
  access: name.endsWith('_factory') ? 'factory' : 'dealer',
  value: 25,
  choices: null,
  free: null,
  description: '',
})

const A: UnitRef = { id: 'cable', url: 'socket://cable:1', unit_key: 'ebl:11' }
const B: UnitRef = { ...A, unit_key: 'ebl:22' }

/** A server with one unit at a time, whose configuration can be changed behind the draft's back. */
class FakeServer {
  unit_key = 'ebl:11'
  values: Record<string, ParameterValue> = { assist_cutoff_kmh: 25, fixed_taper_end_kmh: 24 }
  generation = 1
  reads = 0
  written: [Record<string, ParameterValue>, string, string][] = []

  parameters = async () => Object.keys(this.values).map(parameter)
  config = async () => {
    this.reads += 1
    const stamp = { generation: this.generation, crc32: 1000 + this.generation }
    const { unit_key, values } = this
    return [{ unit_key, ...stamp, parameters: { ...values } }, `"${this.generation}"`]
  }
  writeConfig = async (
    _id: string,
    changes: Record<string, ParameterValue>,
    reason: string,
    tag: string,
  ) => {
    if (tag !== `"${this.generation}"`) throw new Refusal(409, 'config_changed', 'Read it again.')
    this.written.push([changes, reason, tag])
    const changed = Object.entries(changes).map(([name, value]) => ({
      name,
      old: this.values[name] ?? null,
      new: value,
    }))
    Object.assign(this.values, changes)
    this.generation += 1
    const result = {
      unit_key: this.unit_key,
      generation: this.generation,
      crc32: 1000 + this.generation,
      parameters: { ...this.values },
      state: 'committed',
      verified: true,
      changed,
      expires_at: null,
    }
    return [result, `"${this.generation}"`]
  }
}

async function loadedDraft() {
  const server = new FakeServer()
  const draft = new ConfigDraft(A, server as unknown as Server)
  await draft.load()
  return { server, draft }
}

describe('a draft', () => {
  it('holds edits until they are written with the tag they were made for', async () => {
    const { server, draft } = await loadedDraft()

    draft.set('assist_cutoff_kmh', 20)
    expect(server.written).toEqual([])
    await draft.write('quiet street')

    expect(server.written).toEqual([[{ assist_cutoff_kmh: 20 }, 'quiet street', '"1"']])
    expect(draft.changes).toEqual([])
    expect(draft.generation).toBe(2)
  })

  it('is clean again when a value goes back to what the unit has', async () => {
    const { draft } = await loadedDraft()

    draft.set('assist_cutoff_kmh', 20)
    draft.set('assist_cutoff_kmh', 25)

    expect(draft.changes).toEqual([])
  })

  it('undoes a complete drag at once, and redoes it', async () => {
    const { draft } = await loadedDraft()
    for (const value of [24, 23, 22]) draft.set('assist_cutoff_kmh', value, 'drag')

    draft.undo()
    expect(draft.value('assist_cutoff_kmh')).toBe(25)
    draft.redo()
    expect(draft.value('assist_cutoff_kmh')).toBe(22)
  })

  it('keeps its edits when the unit is changed elsewhere', async () => {
    const { server, draft } = await loadedDraft()
    draft.set('assist_cutoff_kmh', 20)

    server.values['assist_cutoff_kmh'] = 18
    server.generation = 5
    await draft.load()

    expect(draft.changes.map(({ old, value }) => [old, value])).toEqual([[18, 20]])
    expect(draft.tag).toBe('"5"')
  })

  it('takes a change back by writing the values it replaced', async () => {
    const { server, draft } = await loadedDraft()
    draft.set('assist_cutoff_kmh', 20)
    const change = await draft.write('')

    await draft.takeBack(change, 'undo')

    expect(server.values['assist_cutoff_kmh']).toBe(25)
  })

  it('takes a change back over what was written elsewhere since', async () => {
    const { server, draft } = await loadedDraft()
    draft.set('assist_cutoff_kmh', 20)
    const change = await draft.write('')
    server.values['fixed_taper_end_kmh'] = 22
    server.generation += 1

    await draft.takeBack(change, 'undo')

    expect(server.values).toEqual({ assist_cutoff_kmh: 25, fixed_taper_end_kmh: 22 })
    expect(draft.base('fixed_taper_end_kmh')).toBe(22)
  })

  it('reads again only when the unit has another configuration', async () => {
    const { server, draft } = await loadedDraft()

    await draft.follow({ generation: 1, crc32: 1001 })
    expect(server.reads).toBe(1)
    server.generation = 2
    await draft.follow({ generation: 2, crc32: 1002 })
    await draft.follow(null) // a unit that does not report which one it has

    expect(server.reads).toBe(3)
  })

  it('does not read what a write is about to return', async () => {
    const { server, draft } = await loadedDraft()
    draft.set('assist_cutoff_kmh', 20)

    const writing = draft.write('')
    await draft.follow({ generation: 2, crc32: 1002 }) // the watch may see it before the answer
    expect(server.reads).toBe(1)
    await writing
    await draft.follow({ generation: 2, crc32: 1002 })

    expect(server.reads).toBe(1)
  })

  it('is the same one when the page is opened again', () => {
    const drafts = new Drafts(new FakeServer() as unknown as Server)

    expect(drafts.of(A, 'tune')).toBe(drafts.of(A, 'tune'))
    expect(drafts.of(A, 'tune')).not.toBe(drafts.of(A, 'sensor'))
  })

  it('keeps what is edited while a write is on its way', async () => {
    const server = new FakeServer()
    const draft = new ConfigDraft(A, server as unknown as Server)
    await draft.load()
    draft.set('assist_cutoff_kmh', 20)

    const writing = draft.write('quiet street')
    draft.set('fixed_taper_end_kmh', 22)
    await writing

    expect(draft.changes.map((change) => change.parameter.name)).toEqual(['fixed_taper_end_kmh'])
  })

  it('has what the unit answered, without another read', async () => {
    const { server, draft } = await loadedDraft()
    draft.set('assist_cutoff_kmh', 20)
    server.values['fixed_taper_end_kmh'] = 23.5 // as the unit rounded it

    await draft.write('')

    expect(draft.base('fixed_taper_end_kmh')).toBe(23.5)
    expect(server.reads).toBe(1)
  })

  it('reads the bounds again that a value of the factory moves', async () => {
    const { server, draft } = await loadedDraft()
    server.values['gain_factory'] = 1
    await draft.load()
    draft.set('gain_factory', 2)

    await draft.write('new sensor')

    expect(server.reads).toBe(3)
  })

  it('has written, even when the unit falls silent before it is read again', async () => {
    const { server, draft } = await loadedDraft()
    server.values['gain_factory'] = 1
    await draft.load()
    const config = server.config
    draft.set('gain_factory', 2)
    server.config = () => Promise.reject(new Refusal(504, 'no_answer', 'The unit is silent.'))

    const change = await draft.write('new sensor')

    expect([change.generation, draft.generation, draft.tag]).toEqual([2, 2, '"2"'])
    expect([draft.base('gain_factory'), draft.changes]).toEqual([2, []])
    server.config = config
    await draft.follow({ generation: 2, crc32: 1002 })
    expect(server.reads).toBe(3)
  })
})

describe('drafts of the bikes that one cable sees', () => {
  const opened = () => {
    const server = new FakeServer()
    return { server, drafts: new Drafts(server as unknown as Server) }
  }

  it('belong to their unit: the one of A is there when A comes back', async () => {
    const { server, drafts } = opened()
    await drafts.of(A, 'tune').load()
    drafts.of(A, 'tune').set('assist_cutoff_kmh', 20)

    server.unit_key = 'ebl:22'
    await drafts.of(B, 'tune').load()

    expect([drafts.count('ebl:11'), drafts.count('ebl:22')]).toEqual([1, 0])
    const elsewhere = drafts.of({ ...A, id: 'other-cable' }, 'tune')
    expect(elsewhere.value('assist_cutoff_kmh')).toBe(20)
    expect(elsewhere.device_id).toBe('other-cable')
  })

  it('take nothing of what another unit has', async () => {
    const { server, drafts } = opened()
    const draft = drafts.of(A, 'tune')
    await draft.load()
    server.unit_key = 'ebl:22'
    server.values = { assist_cutoff_kmh: 18 }

    await expect(draft.load()).rejects.toMatchObject({ status: 412, code: 'other_unit' })
    expect(draft.base('assist_cutoff_kmh')).toBe(25)
    expect(draft.parameters).toHaveLength(2)
  })

  it('do not take a change back on another unit', async () => {
    const { server, drafts } = opened()
    const draft = drafts.of(A, 'tune')
    await draft.load()
    draft.set('assist_cutoff_kmh', 20)
    const change = await draft.write('quiet street')
    Object.assign(server, { unit_key: 'ebl:22', generation: 7, written: [] })

    await expect(draft.takeBack(change, 'undo')).rejects.toMatchObject({ code: 'other_unit' })
    expect(server.written).toEqual([])
  })

  it('stay when a unit without a serial number gets a name', async () => {
    const { server, drafts } = opened()
    const bare = { ...A, unit_key: `bare:url:${A.url}` }
    server.unit_key = bare.unit_key
    await drafts.of(bare, 'tune').load()
    drafts.of(bare, 'tune').set('assist_cutoff_kmh', 20)

    const named = drafts.of({ ...A, unit_key: 'bare:name:Commuter' }, 'tune')
    server.unit_key = 'bare:name:Commuter'
    await named.follow({ generation: 1, crc32: 1001 })

    expect(named.changes.map((change) => change.value)).toEqual([20])
    expect(server.reads).toBe(2)
  })
})

const RULES = 'fuzzy_rules'
const table = (...changed: [number, number, string][]) => {
  const rows = Array.from({ length: 5 }, () => Array.from({ length: 5 }, () => 'ZO'))
  for (const [row, column, label] of changed) (rows[row] ?? [])[column] = label
  return rows
}

describe('an edit of a table', () => {
  const opened = async () => {
    const { server, draft } = await loadedDraft()
    server.values[RULES] = table()
    await draft.load()
    const changeElsewhere = async (...changed: [number, number, string][]) => {
      server.values[RULES] = table(...changed)
      server.generation += 1
      await draft.load()
    }
    return { server, draft, changeElsewhere }
  }

  it('is of an element: what another tab wrote beside it stays', async () => {
    const { server, draft, changeElsewhere } = await opened()
    draft.set(RULES, table([0, 0, 'PB']))

    await changeElsewhere([4, 4, 'NS'])

    expect([draft.count, draft.meanwhile]).toEqual([1, 1])
    await draft.write('mine')
    expect(server.values[RULES]).toEqual(table([0, 0, 'PB'], [4, 4, 'NS']))
    expect(draft.meanwhile).toBe(0)
  })

  it('replaces what another tab made of the same element, and knows of it', async () => {
    const { draft, changeElsewhere } = await opened()
    draft.set(RULES, table([0, 0, 'PB']))

    await changeElsewhere([0, 0, 'NS'])

    expect(draft.value(RULES)).toEqual(table([0, 0, 'PB']))
    expect([draft.base(RULES), draft.before(RULES)]).toEqual([table([0, 0, 'NS']), table()])
  })

  it('is taken back, and made again, without what came from elsewhere', async () => {
    const { draft, changeElsewhere } = await opened()
    draft.set(RULES, table([0, 0, 'PB']))
    draft.set(RULES, table([0, 0, 'PB'], [1, 1, 'PB']))
    await changeElsewhere([4, 4, 'NS'])

    draft.undo()
    expect(draft.value(RULES)).toEqual(table([0, 0, 'PB'], [4, 4, 'NS']))
    draft.redo()
    expect(draft.value(RULES)).toEqual(table([0, 0, 'PB'], [1, 1, 'PB'], [4, 4, 'NS']))
    draft.undo()
    draft.undo()
    expect([draft.count, draft.value(RULES)]).toEqual([0, table([4, 4, 'NS'])])
  })

  it('that is in the unit is undone alone', async () => {
    const { server, draft, changeElsewhere } = await opened()
    draft.set(RULES, table([0, 0, 'PB']))
    const change = await draft.write('mine')
    await changeElsewhere([0, 0, 'PB'], [4, 4, 'NS'])

    await draft.takeBack(change, 'undo')

    expect(server.values[RULES]).toEqual(table([4, 4, 'NS']))
  })

  it('is gone where another tab wrote the same', async () => {
    const { draft, changeElsewhere } = await opened()
    draft.set(RULES, table([0, 0, 'PB']))

    await changeElsewhere([0, 0, 'PB'])

    expect([draft.count, draft.meanwhile]).toEqual([0, 0])
  })

  it('stays complete where the unit has a table of another shape now', async () => {
    const { server, draft } = await opened()
    draft.set(RULES, table([0, 0, 'PB']))
    server.values[RULES] = [['ZO']]
    server.generation += 1

    await draft.load()

    expect(draft.value(RULES)).toEqual(table([0, 0, 'PB']))
  })
})

/** What a browser stores under names. */
const storage = (): Storage => {
  const entries = new Map<string, string>()
  const methods = {
    getItem: (name: string) => entries.get(name) ?? null,
    setItem: (name: string, value: string) => entries.set(name, value),
    removeItem: (name: string) => entries.delete(name),
  }
  return new Proxy(methods as unknown as Storage, {
    ownKeys: () => [...entries.keys()],
    getOwnPropertyDescriptor: () => ({ enumerable: true, configurable: true }),
  })
}

describe('a draft that is not written yet', () => {
  afterEach(() => vi.unstubAllGlobals())

  const browser = () => {
    const [tab, all] = [storage(), storage()]
    vi.stubGlobal('sessionStorage', tab)
    vi.stubGlobal('localStorage', all)
    return { tab, all }
  }
  const visit = (server: FakeServer) => new Drafts(server as unknown as Server)

  it('is restored after a reload, with its reason, on what the unit has by then', async () => {
    browser()
    const server = new FakeServer()
    server.values[RULES] = table()
    const first = visit(server).of(A, 'tune')
    await first.load()
    first.set(RULES, table([0, 0, 'PB']))
    first.reason = 'quiet street'

    server.values[RULES] = table([4, 4, 'NS'])
    server.generation += 1
    const drafts = visit(server)
    expect(drafts.count('ebl:11')).toBe(1)
    const again = drafts.of(A, 'tune')
    await again.load()

    expect(again.value(RULES)).toEqual(table([0, 0, 'PB'], [4, 4, 'NS']))
    expect([again.reason, again.count, again.meanwhile]).toEqual(['quiet street', 1, 1])
    expect(again.stored_at_ms).not.toBeNull()
  })

  it.each(['written', 'discarded', 'set back'])('is kept no longer once it is %s', async (how) => {
    const { tab, all } = browser()
    const server = new FakeServer()
    const draft = visit(server).of(A, 'tune')
    await draft.load()
    draft.set('assist_cutoff_kmh', 20)
    expect(visit(server).count('ebl:11')).toBe(1)

    if (how === 'written') await draft.write('')
    else if (how === 'discarded') draft.discard()
    else draft.set('assist_cutoff_kmh', 25)

    expect(visit(server).count('ebl:11')).toBe(0)
    expect([tab, all].map((place) => Object.keys(place))).toEqual([[], []])
  })

  it('belongs to its unit, whichever comes back first', async () => {
    browser()
    const server = new FakeServer()
    const draft = visit(server).of(A, 'tune')
    await draft.load()
    draft.set('assist_cutoff_kmh', 20)

    const drafts = visit(server)
    server.unit_key = 'ebl:22'
    await drafts.of(B, 'tune').load()

    expect([drafts.count('ebl:22'), drafts.count('ebl:11')]).toEqual([0, 1])
    expect(drafts.of(B, 'tune').value('assist_cutoff_kmh')).toBe(25)
    expect(drafts.of(A, 'tune').value('assist_cutoff_kmh')).toBe(20)
  })

  it('of a tab comes before what another tab kept later', async () => {
    const { tab } = browser()
    const server = new FakeServer()
    const mine = visit(server).of(A, 'tune')
    await mine.load()
    mine.set('assist_cutoff_kmh', 20)
    vi.stubGlobal('sessionStorage', storage())
    const other = visit(server).of(A, 'tune')
    other.set('assist_cutoff_kmh', 18)

    vi.stubGlobal('sessionStorage', tab)
    expect(visit(server).of(A, 'tune').value('assist_cutoff_kmh')).toBe(20)
  })

  it('that cannot be read is forgotten', () => {
    const { all } = browser()
    all.setItem('spindle.draft\nebl:11\ntune', '{"edits":')
    all.setItem('spindle.draft\nebl:11\nmodes', '{}')

    expect(visit(new FakeServer()).count('ebl:11')).toBe(0)
  })

  it('lives on the page alone where the browser keeps nothing', async () => {
    vi.stubGlobal('sessionStorage', {
      setItem: () => {
        throw new DOMException('full', 'QuotaExceededError')
      },
    })
    vi.stubGlobal('localStorage', { removeItem: () => undefined })
    const draft = visit(new FakeServer()).of(A, 'tune')
    await draft.load()

    draft.set('assist_cutoff_kmh', 20)

    expect(draft.value('assist_cutoff_kmh')).toBe(20)
  })
})

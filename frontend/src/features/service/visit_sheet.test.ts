// @vitest-environment happy-dom
/* Goal: what is typed reaches the open visit once and in order, beside what others write, and waits
   in this browser while the server is away.

Method: a server of visits in memory, as the real one answers. */
import { beforeEach, expect, it, vi } from 'vitest'
import { Refusal } from '$shared/api/client'
import type { Visit, VisitServer, VisitWords } from '$shared/api/visit_server'
import { EMPTY } from './sheet_fields'
import { VisitSheet } from './visit_sheet.svelte'

class Server {
  visits: Visit[] = []
  away = false
  requests: string[] = []

  private answer<T>(name: string, work: () => T): Promise<T> {
    this.requests.push(name)
    if (this.away) return Promise.reject(new Refusal(0, 'unreachable', 'away'))
    try {
      return Promise.resolve(structuredClone(work()))
    } catch (error) {
      return Promise.reject(error as Error)
    }
  }

  private only(): Visit {
    return this.visits[0] as Visit
  }

  list() {
    return this.answer('list', () => this.visits)
  }

  get() {
    return this.answer('get', () => this.only())
  }

  open(_bike: number, words: VisitWords & { device_id?: string | null }) {
    return this.answer('open', () => {
      if (this.visits.length > 0) throw new Refusal(409, 'visit_open', 'open')
      const { device_id, ...written } = words
      void device_id
      const content = { ...EMPTY, faults: [], ...written }
      const visit = { id: 1, state: 'open', version: 1, content } as unknown as Visit
      this.visits = [visit]
      return visit
    })
  }

  change(_id: number, version: number, words: VisitWords) {
    return this.answer('change', () => {
      const visit = this.only()
      if (visit.version !== version) throw new Refusal(409, 'visit_changed', 'changed')
      const content = { ...visit.content, ...words } as Visit['content']
      this.visits = [{ ...visit, version: version + 1, content }]
      return this.only()
    })
  }

  /** Somebody else writes. */
  elsewhere(words: VisitWords) {
    const visit = this.only()
    const content = { ...visit.content, ...words } as Visit['content']
    this.visits = [{ ...visit, version: visit.version + 1, content }]
  }
}

let server: Server
beforeEach(() => {
  localStorage.clear()
  vi.useFakeTimers()
  server = new Server()
})

async function opened(): Promise<VisitSheet> {
  const sheet = new VisitSheet(server as unknown as VisitServer, 1, 'unit', 'Ben', () => null)
  await sheet.load()
  return sheet
}

async function type(sheet: VisitSheet, words: Partial<VisitSheet['fields']>, wait_ms = 1000) {
  Object.assign(sheet.fields, words)
  sheet.edited()
  await vi.advanceTimersByTimeAsync(wait_ms)
}

it('begins a visit with the first words, and none by being looked at', async () => {
  const sheet = await opened()
  sheet.suggest('counter_km', 12)
  await vi.advanceTimersByTimeAsync(60_000)
  expect(server.requests).toEqual(['list'])

  await type(sheet, { complaint: 'No' }, 100)
  await type(sheet, { complaint: 'No help' })
  expect(server.requests).toEqual(['list', 'open'])
  const { complaint, technician, counter_km } = server.visits[0]?.content ?? EMPTY
  expect([complaint, technician, counter_km]).toEqual(['No help', 'Ben', 12])
  expect(sheet.saved).toBe(true)
})

it('writes beside somebody else, whose words it shows', async () => {
  const [one, two] = [await opened(), await opened()]
  await type(one, { complaint: 'No help' })
  await type(two, { done: 'Plug dried' })
  server.elsewhere({ notes: 'wet' })
  await type(one, { job: '0815' })

  expect(server.visits[0]?.content).toMatchObject({
    complaint: 'No help',
    done: 'Plug dried',
    notes: 'wet',
    job: '0815',
  })
  expect([one.fields.done, one.fields.notes]).toEqual(['Plug dried', 'wet'])
})

it('waits while the server is away, in this page and in the next', async () => {
  const sheet = await opened()
  server.away = true
  await type(sheet, { complaint: 'No help' })
  expect(sheet.problem?.status).toBe(0)
  sheet.leave()
  await vi.advanceTimersByTimeAsync(60_000)

  server.away = false
  const next = await opened()
  expect(next.fields.complaint).toBe('No help')
  await vi.advanceTimersByTimeAsync(1000)
  expect(server.visits[0]?.content.complaint).toBe('No help')
  expect([next.saved, localStorage.length]).toEqual([true, 0])
})

it('sends what was typed while it was sending', async () => {
  const sheet = await opened()
  await type(sheet, { complaint: 'No help' }, 700)
  sheet.fields.done = 'Plug'
  sheet.edited()
  await vi.advanceTimersByTimeAsync(2000)
  expect(server.visits[0]?.content).toMatchObject({ complaint: 'No help', done: 'Plug' })
})

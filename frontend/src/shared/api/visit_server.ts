// Service visits of bikes. Loaded with the pages that use it. Throws Refusal.
import type { components } from '$generated/api'
import { body, refusal, Refusal, type Http } from './client'
import type { Ride } from './types'

type Schemas = components['schemas']
export type Visit = Schemas['Visit']
export type VisitContent = Schemas['VisitContent']
export type VisitFault = Schemas['VisitFault']
export type VisitReadings = Schemas['VisitReadings']
export type VisitIn = Schemas['VisitIn']
export type VisitWords = Partial<Omit<VisitIn, 'device_id'>>
export type Strokes = number[][]

export class VisitServer {
  constructor(private readonly http: Http) {}

  private at(visit_id: number) {
    return { params: { path: { visit_id } } }
  }

  /** The visits of a bike, the newest first. */
  async list(bike_id: number): Promise<Visit[]> {
    const path = { params: { path: { bike_id } } }
    return (await body(this.http.GET('/api/v1/bikes/{bike_id}/visits', path))).items
  }

  get(id: number): Promise<Visit> {
    return body(this.http.GET('/api/v1/visits/{visit_id}', this.at(id)))
  }

  open(bike_id: number, words: Partial<VisitIn>): Promise<Visit> {
    const path = { params: { path: { bike_id } } }
    const request = { ...path, body: words as VisitIn }
    return body(this.http.POST('/api/v1/bikes/{bike_id}/visits', request))
  }

  /** What is absent stays. version: that the words were written over. */
  change(id: number, version: number, words: VisitWords): Promise<Visit> {
    const written = { ...words, version } as Schemas['VisitChangeIn']
    const request = { ...this.at(id), body: written }
    return body(this.http.PATCH('/api/v1/visits/{visit_id}', request))
  }

  /** Looks at the unit, for before or after the work. */
  look(id: number, device_id: string): Promise<Visit> {
    const request = { ...this.at(id), body: { device_id } }
    return body(this.http.POST('/api/v1/visits/{visit_id}/readings', request))
  }

  close(id: number): Promise<Visit> {
    return body(this.http.POST('/api/v1/visits/{visit_id}/close', this.at(id)))
  }

  async remove(id: number): Promise<void> {
    await body(this.http.DELETE('/api/v1/visits/{visit_id}', this.at(id)))
  }

  /** name and strokes: of a signature; an owner with an account has none. */
  consent(visit: Visit, name = '', strokes: Strokes = []): Promise<Visit> {
    const consented = { content_sha256: visit.content_sha256, name, strokes }
    const request = { ...this.at(visit.id), body: consented }
    return body(this.http.POST('/api/v1/visits/{visit_id}/consent', request))
  }

  /** A bike's latest ride that is over and began between two moments; to: null for now. */
  async lastRide(bike: number, from: string, to: string | null): Promise<Ride | null> {
    const query = { bike, from, to, limit: 5 }
    const { items } = await body(this.http.GET('/api/v1/rides', { params: { query } }))
    return items.find(({ state }) => state === 'done') ?? null
  }

  async addPhoto(id: number, file: File): Promise<Visit> {
    const place = `api/v1/visits/${id}/photos?name=${encodeURIComponent(file.name.slice(-120))}`
    return (await sent(place, file)) as Visit
  }

  removePhoto(visit_id: number, sha256: string): Promise<Visit> {
    const path = { params: { path: { visit_id, sha256 } } }
    return body(this.http.DELETE('/api/v1/visits/{visit_id}/photos/{sha256}', path))
  }

  async addHistory(bike_id: number, file: File): Promise<Schemas['HistoryAdded']> {
    return (await sent(historyPath(bike_id), file)) as Schemas['HistoryAdded']
  }
}

/** Where a photograph of a visit is. */
export function photoPath(visit_id: number, sha256: string): string {
  return `api/v1/visits/${visit_id}/photos/${sha256}`
}

/** Where the history of a bike is, as a file. */
export function historyPath(bike_id: number): string {
  return `api/v1/bikes/${bike_id}/history`
}

/** A file as the body of a request. */
async function sent(place: string, file: File): Promise<unknown> {
  let response: Response
  try {
    response = await fetch(place, { method: 'POST', body: file })
  } catch (error) {
    throw new Refusal(0, 'unreachable', String(error))
  }
  const content: unknown = await response.json().catch(() => null)
  if (!response.ok) throw refusal(response.status, content)
  return content
}

// The register of bikes, their owners, and the codes by which they change hands. Loaded with the
// pages that use it. Throws Refusal.
import type { components } from '$generated/api'
import { body, type Http } from './client'

type Schemas = components['schemas']
export type Bike = Schemas['Bike']
export type BikeDetail = Schemas['BikeDetail']
export type BikeOwner = Schemas['BikeOwner']
export type BikeIn = Schemas['BikeIn']
export type BikeChange = Schemas['BikeChange']
export type Pairing = Schemas['Pairing']
export type Offer = Schemas['Offer']
export type Joined = Schemas['Joined']

export class BikeServer {
  constructor(private readonly http: Http) {}

  private at(bike_id: number) {
    return { params: { path: { bike_id } } }
  }

  async list(): Promise<Bike[]> {
    return (await body(this.http.GET('/api/v1/bikes'))).items
  }

  get(bike_id: number): Promise<BikeDetail> {
    return body(this.http.GET('/api/v1/bikes/{bike_id}', this.at(bike_id)))
  }

  add(bike: BikeIn): Promise<BikeDetail> {
    return body(this.http.POST('/api/v1/bikes', { body: bike }))
  }

  change(bike_id: number, change: BikeChange): Promise<BikeDetail> {
    const request = { ...this.at(bike_id), body: change }
    return body(this.http.PATCH('/api/v1/bikes/{bike_id}', request))
  }

  async remove(bike_id: number): Promise<void> {
    await body(this.http.DELETE('/api/v1/bikes/{bike_id}', this.at(bike_id)))
  }

  /** Rides were made with this bike. */
  async giveRides(bike_id: number, ride_ids: number[]): Promise<void> {
    const request = { ...this.at(bike_id), body: { ride_ids } }
    await body(this.http.POST('/api/v1/bikes/{bike_id}/rides', request))
  }

  /** A code that makes whoever takes it the owner. owned_from: since when, as ISO 8601; null for
      the moment it is taken. */
  pair(bike_id: number, owned_from: string | null): Promise<Pairing> {
    const request = { ...this.at(bike_id), body: { owned_from } }
    return body(this.http.POST('/api/v1/bikes/{bike_id}/pairing', request))
  }

  /** The bike is nobody's from now on. */
  async leave(bike_id: number): Promise<void> {
    await body(this.http.DELETE('/api/v1/bikes/{bike_id}/owner', this.at(bike_id)))
  }

  /** Which bike a code gives; nobody needs to be signed in. */
  offer(code: string): Promise<Offer> {
    return body(this.http.GET('/api/v1/pairings/{code}', { params: { path: { code } } }))
  }

  /** Makes the signed-in user the owner. */
  take(code: string): Promise<BikeDetail> {
    return body(this.http.POST('/api/v1/pairings/{code}', { params: { path: { code } } }))
  }

  /** A rider's account by the code of their bike; signs them in. */
  join(code: string, name: string, password: string): Promise<Joined> {
    const request = { params: { path: { code } }, body: { name, password } }
    return body(this.http.POST('/api/v1/pairings/{code}/account', request))
  }
}

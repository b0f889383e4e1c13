// Who signs in, accounts and keys. Loaded with the pages that use them. Throws Refusal.
import type { components } from '$generated/api'
import { body, type Http } from './client'

type Schemas = components['schemas']
export type Person = Schemas['Person']
export type Role = Person['role']
export type Session = Schemas['Session']
export type ApiKey = Schemas['ApiKey']
export type NewApiKey = Schemas['NewApiKey']
export type ApiKeyIn = Schemas['ApiKeyIn']
export type PersonChange = Schemas['PersonChange']
export type Permission = ApiKey['scopes'][number]

export class PeopleServer {
  constructor(private readonly http: Http) {}

  session(): Promise<Session> {
    return body(this.http.GET('/api/v1/session'))
  }

  signIn(name: string, password: string): Promise<Person> {
    return body(this.http.POST('/api/v1/sign-in', { body: { name, password } }))
  }

  /** The first administrator, by the token of the link that the server printed. */
  makeFirst(token: string, name: string, password: string): Promise<Person> {
    return body(this.http.POST('/api/v1/first-person', { body: { token, name, password } }))
  }

  async signOut(everywhere = false): Promise<void> {
    await body(this.http.DELETE('/api/v1/session', { params: { query: { everywhere } } }))
  }

  async changePassword(old: string, password: string): Promise<void> {
    await body(this.http.PUT('/api/v1/session/password', { body: { old, new: password } }))
  }

  async people(): Promise<Person[]> {
    return (await body(this.http.GET('/api/v1/people'))).items
  }

  add(name: string, role: Role, password: string): Promise<Person> {
    return body(this.http.POST('/api/v1/people', { body: { name, role, password } }))
  }

  change(person_id: number, change: PersonChange): Promise<Person> {
    const params = { path: { person_id } }
    return body(this.http.PATCH('/api/v1/people/{person_id}', { params, body: change }))
  }

  async remove(person_id: number): Promise<void> {
    await body(this.http.DELETE('/api/v1/people/{person_id}', { params: { path: { person_id } } }))
  }

  async keys(): Promise<ApiKey[]> {
    return (await body(this.http.GET('/api/v1/keys'))).items
  }

  addKey(key: ApiKeyIn): Promise<NewApiKey> {
    return body(this.http.POST('/api/v1/keys', { body: key }))
  }

  async revokeKey(key_id: number): Promise<void> {
    await body(this.http.DELETE('/api/v1/keys/{key_id}', { params: { path: { key_id } } }))
  }
}

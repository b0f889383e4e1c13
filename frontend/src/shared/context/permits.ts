// What the signed-in user may do; everything on a server without accounts. Known before the first
// page: a page that somebody may not have would get nothing but refusals.
import { body, Refusal, type Http } from '../api/client'
import type { Permission, Person } from '../api/people_server'
import { isSignedIn } from '../api/signed_in'

export class Permits {
  /** Null where nobody is signed in, and on a server without accounts. */
  person: Person | null = null
  /** Null: everything. */
  private permitted: ReadonlySet<Permission> | null = null

  /** Requests nothing where nobody signed in with this browser. */
  async load(http: Http): Promise<void> {
    if (!isSignedIn()) return
    try {
      const { signed_in } = await body(http.GET('/api/v1/session'))
      if (signed_in) this.take(signed_in)
    } catch (error) {
      // The server decides by itself, and the banner reports one that is away.
      if (!(error instanceof Refusal)) throw error
    }
  }

  take({ person, permissions }: { person: Person; permissions: readonly Permission[] }): void {
    this.person = person
    this.permitted = new Set(permissions)
  }

  has(permission: Permission): boolean {
    return this.permitted?.has(permission) ?? true
  }

  /** Only their own bikes and rides, as riders: others' are the workshop's affair. */
  get own_only(): boolean {
    return this.person?.role === 'rider'
  }
}

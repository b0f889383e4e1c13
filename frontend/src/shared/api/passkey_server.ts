// Passkeys of oneself, and signing in with one. Loaded with what uses it. Throws Refusal.
import type { components } from '$generated/api'
import { body, type Http } from './client'

type Schemas = components['schemas']
export type Passkey = Schemas['Passkey']
export type NewPasskeyChallenge = Schemas['NewPasskeyChallenge']
export type PasskeyChallenge = Schemas['PasskeyChallenge']
export type PasskeyIn = Schemas['PasskeyIn']
export type PasskeyProof = Schemas['PasskeyProof']

export class PasskeyServer {
  constructor(private readonly http: Http) {}

  async list(): Promise<Passkey[]> {
    return (await body(this.http.GET('/api/v1/session/passkeys'))).items
  }

  /** password: one's own, as it is now. */
  begin(password: string): Promise<NewPasskeyChallenge> {
    return body(this.http.POST('/api/v1/session/passkeys/challenges', { body: { password } }))
  }

  add(passkey: PasskeyIn): Promise<Passkey> {
    return body(this.http.POST('/api/v1/session/passkeys', { body: passkey }))
  }

  async remove(passkey_id: number): Promise<void> {
    const params = { path: { passkey_id } }
    await body(this.http.DELETE('/api/v1/session/passkeys/{passkey_id}', { params }))
  }

  beginSignIn(): Promise<PasskeyChallenge> {
    return body(this.http.POST('/api/v1/sign-in/passkey/challenges'))
  }

  async signIn(proof: PasskeyProof): Promise<void> {
    await body(this.http.POST('/api/v1/sign-in/passkey', { body: proof }))
  }
}

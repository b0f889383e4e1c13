// What the browser and the authenticator do with a challenge (W3C Web Authentication, level 3).
import type {
  NewPasskeyChallenge,
  PasskeyChallenge,
  PasskeyIn,
  PasskeyProof,
} from '$shared/api/passkey_server'

/** Whether this browser has passkeys at all; over plain http none has. */
export const hasPasskeys = (): boolean => 'PublicKeyCredential' in window

export function bytesOf(text: string): Uint8Array<ArrayBuffer> {
  const base64 = text.replaceAll('-', '+').replaceAll('_', '/')
  return Uint8Array.from(atob(base64), (one) => one.charCodeAt(0))
}

export function base64url(bytes: ArrayBuffer): string {
  const text = Array.from(new Uint8Array(bytes), (one) => String.fromCharCode(one)).join('')
  return btoa(text).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '')
}

/** Has an authenticator make a passkey. Throws DOMException: `InvalidStateError` where it has one
    already, `NotAllowedError` where nobody agreed in time. */
export async function make(challenge: NewPasskeyChallenge): Promise<Omit<PasskeyIn, 'name'>> {
  const made = await navigator.credentials.create({
    publicKey: {
      challenge: bytesOf(challenge.challenge),
      rp: { id: challenge.rp_id, name: 'Spindle' },
      user: {
        id: bytesOf(challenge.user_handle),
        name: challenge.user_name,
        displayName: challenge.user_name,
      },
      pubKeyCredParams: challenge.algorithms.map((alg) => ({ type: 'public-key', alg })),
      excludeCredentials: challenge.known.map((id) => ({ type: 'public-key', id: bytesOf(id) })),
      authenticatorSelection: {
        residentKey: 'required',
        requireResidentKey: true,
        userVerification: 'required',
      },
      attestation: 'none',
      timeout: challenge.valid_s * 1000,
    },
  })
  const response = (made as PublicKeyCredential).response as AuthenticatorAttestationResponse
  return {
    client_data: base64url(response.clientDataJSON),
    attestation: base64url(response.attestationObject),
  }
}

/** Has an authenticator sign in whoever it knows. Throws DOMException, as `make`. */
export async function prove(challenge: PasskeyChallenge): Promise<PasskeyProof> {
  const found = (await navigator.credentials.get({
    publicKey: {
      challenge: bytesOf(challenge.challenge),
      rpId: challenge.rp_id,
      userVerification: 'required',
      timeout: challenge.valid_s * 1000,
    },
  })) as PublicKeyCredential
  const response = found.response as AuthenticatorAssertionResponse
  return {
    credential_id: base64url(found.rawId),
    client_data: base64url(response.clientDataJSON),
    authenticator_data: base64url(response.authenticatorData),
    signature: base64url(response.signature),
    user_handle: base64url(response.userHandle ?? new ArrayBuffer(0)),
  }
}

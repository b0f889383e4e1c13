// The only door to HTTP. Every refusal becomes a Refusal, with the fields at fault.
import type { paths } from '$generated/api'
import createClient, { type Client } from 'openapi-fetch'
import type { Author } from './author.svelte'
import { here } from './place'
import { SIGN_IN, isAlone } from './signed_in'
import type { FieldProblem, Problem, TokenChallenge } from './types'

/** Why a request did not succeed. status 0: the server did not answer at all. */
export class Refusal extends Error {
  constructor(
    readonly status: number,
    readonly code: string,
    detail: string,
    readonly errors: FieldProblem[] = [],
    /** What the maker has to sign, when a token would do. */
    readonly challenge: TokenChallenge | null = null,
    /** What became of a change whose answer was lost, where the server found it out. */
    readonly outcome: Problem['outcome'] = null,
  ) {
    super(detail)
  }
}

export type Http = Client<paths>

const OF_A_CONNECTION = /\/api\/v1\/devices\/([^/]+)\//

/** The key of the unit that the page shows on a connection; null while unknown. */
export type KeyOf = (device_id: string) => string | null

/** A client of the server this page came from, whose changes carry the author's name and which unit
    they are for: another one may have come onto its connection. */
export function openHttp(author: Author, keyOf: KeyOf, base = document.baseURI): Http {
  const client = createClient<paths>({ baseUrl: base })
  client.use({
    onRequest({ request }) {
      if (request.method === 'GET') return request
      const name = author.name.trim()
      if (name) request.headers.set('spindle-author', encodeURIComponent(name))
      const id = OF_A_CONNECTION.exec(new URL(request.url).pathname)?.[1]
      const key = id === undefined ? null : keyOf(decodeURIComponent(id))
      if (key !== null) request.headers.set('spindle-unit', encodeURIComponent(key))
      return request
    },
    onResponse({ response }) {
      const { pathname, search } = location
      // A page without the others says by itself what is wrong.
      if (response.status === 401 && !isAlone(here())) {
        location.assign(`${SIGN_IN}?back=${encodeURIComponent(pathname + search)}`)
      }
    },
  })
  return client
}

interface Answer<T> {
  data?: T | undefined
  error?: unknown
  response: Response
}

/** The body of an answer; throws Refusal. */
export async function body<T>(pending: Promise<Answer<T>>): Promise<T> {
  return (await bodyAndTag(pending))[0]
}

/** The body and the ETag of an answer; throws Refusal. */
export async function bodyAndTag<T>(pending: Promise<Answer<T>>): Promise<[T, string]> {
  let answer: Answer<T>
  try {
    answer = await pending
  } catch (error) {
    if (error instanceof DOMException && error.name === 'AbortError') throw error
    throw new Refusal(0, 'unreachable', String(error))
  }
  if (!answer.response.ok) throw refusal(answer.response.status, answer.error)
  return [answer.data as T, answer.response.headers.get('etag') ?? '']
}

/** A Refusal from a status and whatever body came with it. */
export function refusal(status: number, content: unknown): Refusal {
  if (content && typeof content === 'object' && 'detail' in content) {
    const { code = 'error', detail, errors, challenge, outcome } = content as Partial<Problem>
    return new Refusal(status, code, String(detail), errors, challenge, outcome)
  }
  return new Refusal(status, 'error', `The server answered with status ${status}.`)
}

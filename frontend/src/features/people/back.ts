// Where to go after signing in. Only to a page of this server: the address is anybody's to write.
import { placeOf } from '$shared/api/place'
import { SIGN_IN } from '$shared/api/signed_in'

/** base: where the server is, as `http://shop:8750/`. */
export function returnAddress(search: string, base: string): string {
  const root = new URL(base).pathname
  const target = new URLSearchParams(search).get('back') ?? root
  let to: URL
  try {
    to = new URL(target, base)
  } catch {
    return root
  }
  const ours = to.href.startsWith(base) && placeOf(to.pathname, root) !== SIGN_IN
  return ours && !to.pathname.startsWith('//') ? to.pathname + to.search : root
}

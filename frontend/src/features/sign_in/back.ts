// Where to go after signing in. Only to a page of this server: the address is anybody's to write.
import { SIGN_IN } from '$shared/api/signed_in'

export function wayBack(search: string, origin: string): string {
  const asked = new URLSearchParams(search).get('back') ?? '/'
  let to: URL
  try {
    to = new URL(asked, origin)
  } catch {
    return '/'
  }
  const ours = to.origin === origin && to.pathname !== SIGN_IN && !to.pathname.startsWith('//')
  return ours ? to.pathname + to.search : '/'
}

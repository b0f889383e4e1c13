// The kind of an address while it is typed, as the server will read it.

export type AddressKind = 'simulated' | 'socket' | 'serial' | 'socket_part' | 'not_an_address'

/** The kind of a way to a unit; `socket_part` and `not_a_way` are none yet; null: nothing typed. */
export function addressKind(address: string): AddressKind | null {
  const url = address.trim()
  if (url === '') return null
  if (/^sim($|[:?])/.test(url)) return 'simulated'
  if (url.startsWith('socket://')) {
    const port = Number(/^socket:\/\/(?:\[[^\]/]+\]|[^:/?#\s]+):(\d+)(?:[/?].*)?$/.exec(url)?.[1])
    return port >= 1 && port <= 65535 ? 'socket' : 'socket_part'
  }
  return url.includes('://') ? 'not_an_address' : 'serial'
}

export function isConnectable(kind: AddressKind | null): boolean {
  return kind === 'simulated' || kind === 'socket' || kind === 'serial'
}

/** The address of a simulated unit that is not there yet. */
export function newSimulated(taken: readonly string[]): string {
  let number = 1
  while (taken.includes(`sim:bench-${number}`)) number += 1
  return `sim:bench-${number}`
}

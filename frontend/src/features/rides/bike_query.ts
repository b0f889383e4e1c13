// Which bike's rides an address is about: a link shows what its sender saw.

export function bikeIn(search: string): number | null {
  return Number(new URLSearchParams(search).get('bike')) || null
}

/** The address's query about another bike, or about all; what else it says stays. */
export function searchOf(bike: number | null, search: string): string {
  const query = new URLSearchParams(search)
  if (bike === null) query.delete('bike')
  else query.set('bike', String(bike))
  return query.size > 0 ? `?${query}` : ''
}

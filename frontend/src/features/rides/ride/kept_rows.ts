// Which rows of traces this browser shows where a link does not say.
const KEY = 'spindle.ride-rows'

export function keptRows(): string[] {
  return (localStorage.getItem(KEY) ?? '').split(',').filter((key) => key !== '')
}

/** None: the usual ones. */
export function keepRows(keys: string[]): void {
  localStorage.setItem(KEY, keys.join())
}

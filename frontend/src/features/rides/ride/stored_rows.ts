// Which rows of traces this browser shows where a link does not say.
const KEY = 'spindle.ride-rows'

export function storedRows(): string[] {
  return (localStorage.getItem(KEY) ?? '').split(',').filter((key) => key !== '')
}

/** None: the usual ones. */
export function storeRows(keys: string[]): void {
  localStorage.setItem(KEY, keys.join())
}

// The code of a bike as people type it.
const LENGTH = 8

/** `XXXX-XXXX` from whatever case, spaces and dashes; null where it cannot be a code. */
export function readCode(typed: string): string | null {
  const plain = typed.toUpperCase().replace(/[\s-‐–—_.]/g, '')
  if (plain.length !== LENGTH || !/^[0-9A-Z]+$/.test(plain)) return null
  return `${plain.slice(0, LENGTH / 2)}-${plain.slice(LENGTH / 2)}`
}

/** The code in the part of an address behind its `#`; empty where there is none. */
export function codeIn(hash: string): string {
  return decode(hash.replace(/^#/, ''))
}

function decode(text: string): string {
  try {
    return decodeURIComponent(text)
  } catch {
    return text
  }
}

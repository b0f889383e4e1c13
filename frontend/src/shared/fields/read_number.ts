// Numbers as people type and paste them. Pure; every field of every page reads with these two.

const NUMBER = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i
const GROUPED = /^[+-]?\d{1,3}([ .,'])\d{3}(\1\d{3})*((?!\1)[.,]\d*)?$/

/** The number that a text says; NaN for anything else, so that nothing of it is dropped unseen.
    Comma and point both part the decimals, thousands may be in groups, and the field's own unit may
    stand behind. */
export function readNumber(text: string, unit = ''): number {
  const plain = withoutUnit(inPlainSigns(text), unit)
  const separator = GROUPED.exec(plain)?.[1]
  // "1,234" has one comma alone: that parts decimals, as it does in "1,2".
  const grouped = separator && (/[ ']/.test(separator) || /[.,].*[.,]/.test(plain))
  const number = (grouped ? plain.replaceAll(separator, '') : plain).replace(',', '.')
  return NUMBER.test(number) ? Number(number) : NaN
}

/** The numbers of a list. A comma between two digits could part two numbers or the decimals of one:
    unless something else parts the list, that is NaN, not a guess. */
export function readNumbers(text: string, unit = ''): number[] {
  const plain = inPlainSigns(text.replaceAll('，', ', '))
  const parts = plain.split(/ ?[;、] ?|, | /).filter((part) => part && !isUnit(part, unit))
  const unsure = parts.length === 1 && /\d,\d/.test(plain)
  return unsure ? [NaN] : parts.map((part) => readNumber(part, unit))
}

/** Whether every number in a value is one: no field of it holds what could not be read. */
export function allRead(value: unknown): boolean {
  if (typeof value === 'number') return Number.isFinite(value)
  return value === null || typeof value !== 'object' || Object.values(value).every(allRead)
}

/** Full-width digits as plain ones, and one kind of space, of minus and of apostrophe. */
function inPlainSigns(text: string): string {
  return text
    .normalize('NFKC')
    .replace(/[\u2212\u2010-\u2014]/g, '-')
    .replace(/[\u2018\u2019\u02bc]/g, "'")
    .replace(/\s+/g, ' ')
    .trim()
}

const bare = (unit: string) => unit.normalize('NFKC').replace('±', '').trim().toLowerCase()
const isUnit = (text: string, unit: string) => text.toLowerCase() === bare(unit)

function withoutUnit(text: string, unit: string): string {
  const own = bare(unit)
  return own && text.toLowerCase().endsWith(own) ? text.slice(0, -own.length).trim() : text
}

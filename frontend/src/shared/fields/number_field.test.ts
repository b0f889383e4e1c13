// @vitest-environment happy-dom
/* Goal: one number field, whose text never stands for another number than the one that it gives.
   Values are the numbers as spoken. */
import { flushSync, mount, unmount, type Component } from 'svelte'
import { afterEach, beforeEach, expect, it, vi } from 'vitest'
import { provideAppContext, type AppContext } from '../context/app_context'
import { Locale } from '../i18n/locale.svelte'
import { Units, type System } from '../units/units.svelte'
import NumberField from './NumberField.svelte'

const locale = new Locale()
const onvalue = vi.fn()
const ondone = vi.fn()
let app: Record<string, unknown>
let input: HTMLInputElement

function show(more: Record<string, unknown> = {}, system: System = 'metric') {
  const InApp = ((...given: Parameters<typeof NumberField>) => {
    provideAppContext({ locale, units: new Units(locale, system) } as AppContext)
    return NumberField(...given)
  }) as unknown as Component<Record<string, unknown>>
  const props = { label: 'Crank', value: 172.5, unit: 'mm', onvalue, ondone, ...more }
  app = mount(InApp, { target: document.body, props, context: new Map() })
  flushSync()
  input = document.querySelector('input') as HTMLInputElement
  input.focus()
}

function type(text: string) {
  input.value = text
  input.dispatchEvent(new Event('input', { bubbles: true }))
  flushSync()
}

function press(key: string): Event {
  const event = new KeyboardEvent('keydown', { key, bubbles: true, cancelable: true })
  input.dispatchEvent(event)
  flushSync()
  return event
}

function leave() {
  input.blur()
  flushSync()
}

const marked = () => input.getAttribute('aria-invalid') === 'true'

beforeEach(() => vi.clearAllMocks())
afterEach(() => unmount(app))

it.each([
  ['172,5', 172.5],
  ['165.0', 165],
  ['1 234,5', 1234.5],
  ['165 mm', 165],
])('gives what %j means, and shows it plainly once it is left', (text, value) => {
  show()
  type(text)

  expect(onvalue).toHaveBeenLastCalledWith(value)
  expect(input.value).toBe(text)
  leave()
  expect([input.value, marked()]).toEqual([String(value), false])
})

it.each(['', '172,5,0', '6 inches', '-'])('gives no number for %j, and keeps it', (text) => {
  show()
  type(text)
  leave()

  expect(onvalue).toHaveBeenLastCalledWith(NaN)
  expect([input.value, marked()]).toEqual([text, true])
  expect(ondone).not.toHaveBeenCalled()
})

it('says from where to where it goes', () => {
  show({ min: 50, max: 1000 })
  type('17.25')

  expect(onvalue).toHaveBeenLastCalledWith(NaN)
  expect(document.body.textContent).toContain('A number from 50 to 1000.')
})

it('takes whole numbers alone where only those are meant', () => {
  show({ integer: true, value: 2, unit: '' })
  type('2,5')

  expect([onvalue.mock.lastCall, marked()]).toEqual([[NaN], true])
})

it('may stay empty where it is optional', () => {
  show({ optional: true })
  type(' ')
  leave()

  expect([onvalue.mock.lastCall, ondone.mock.lastCall, marked()]).toEqual([[null], [null], false])
})

it('stays as it is under the wheel', () => {
  show()
  input.dispatchEvent(new WheelEvent('wheel', { deltaY: -400, bubbles: true }))
  flushSync()

  expect([input.value, onvalue.mock.calls]).toEqual(['172.5', []])
})

it('goes by its step with the arrows, and not beyond its end', () => {
  show({ step: 0.5, max: 173 })
  press('ArrowUp')
  expect(input.value).toBe('173')
  press('ArrowUp')
  expect(input.value).toBe('173')
})

it('takes back what was typed with Escape, which closes nothing around it', () => {
  show()
  type('9')
  const escape = press('Escape')

  expect([input.value, escape.defaultPrevented]).toEqual(['172.5', true])
  expect(onvalue).toHaveBeenLastCalledWith(172.5)
  expect(press('Escape').defaultPrevented).toBe(false)
})

it('is done once, when it is left or Enter is pressed', () => {
  show()
  type('165')
  press('Enter')
  leave()

  expect(ondone.mock.calls).toEqual([[165]])
})

it('reads and shows in the units of the reader', () => {
  show({ value: 20, unit: 'degC' }, 'imperial')

  expect(input.value).toBe('68')
  type('50 °F')
  expect(onvalue.mock.lastCall?.[0]).toBeCloseTo(10, 9)
})

/* Goal: signing in leads back to a page of this server and to no other. */
import { expect, it } from 'vitest'
import { returnAddress } from './back'

const at = (back: string) => returnAddress(`?back=${encodeURIComponent(back)}`, 'http://shop:8750')

it.each([
  ['/rides/7?axis=distance', '/rides/7?axis=distance'],
  ['http://shop:8750/tune', '/tune'],
])('goes back to %s', (back, to) => expect(at(back)).toBe(to))

it.each([
  'http://evil.example/',
  '//evil.example/rides',
  '/\\evil.example',
  'javascript:alert(1)',
  'http://',
  '/sign-in?back=/sign-in',
  '/.//evil.example',
])('does not go to %s', (back) => expect(at(back)).toBe('/'))

it('goes to the first page without a return address', () => {
  expect(returnAddress('', 'http://shop:8750')).toBe('/')
})

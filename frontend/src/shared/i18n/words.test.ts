/* Goal: both languages say the same with the same values, and numbers look as readers write them.
   That no key is missing is checked by the compiler. */
import { CHANNELS, FLAGS, PARAMETERS } from '$generated/registry'
import { expect, it } from 'vitest'
import { en } from './en'
import { clock, Locale } from './locale.svelte'
import { zh } from './zh'

const holes = (words: string) => [...words.matchAll(/\{(\w+)\}/g)].map((m) => m[1]).sort()

it('uses the same values in English and Chinese', () => {
  for (const [key, words] of Object.entries(en)) {
    expect([key, holes(zh[key as keyof typeof en])]).toEqual([key, holes(words)])
  }
})

it('names every parameter and flag the registry has today', () => {
  const flags = Object.keys(FLAGS.limit_flags).map((name) => `limit.${name}`)
  const faults = Object.keys(FLAGS.fault_flags).map((name) => `fault_flag.${name}`)
  const parameters = Object.keys(PARAMETERS).map((name) => `parameter.${name}`)

  const unnamed = [...flags, ...faults, ...parameters].filter((key) => !(key in en))

  expect(unnamed).toEqual([])
  expect(Object.keys(CHANNELS)).toContain('fuzzy_gain')
})

it('shows a missing number as a dash, never as zero', () => {
  const locale = new Locale()

  expect([locale.number(null), locale.number(NaN), locale.number(0)]).toEqual(['—', '—', '0'])
})

it('calls no share whole that is not', () => {
  const locale = new Locale()

  expect([locale.share(0.99995), locale.share(1)]).toEqual(['99.9', '100.0'])
})

it("tells the server's findings in Chinese with the numbers of the English", async () => {
  const values = { market: '日本', speed_kmh: 24 }
  const locale = new Locale()
  const said = () => locale.said('lint', 'cutoff_above_market', 'as the server says it', values)

  expect(said()).toBe('as the server says it')
  await locale.speak('zh')
  expect(said()).toContain('（日本）')
  expect(said()).toContain('24 km/h')
})

it('writes durations as a clock', () => {
  expect([clock(59), clock(3600), clock(7325)]).toEqual(['0:59', '1:00:00', '2:02:05'])
})

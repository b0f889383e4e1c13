/* Goal: both languages say the same with the same values, and numbers look as readers write them.
   What is named by the registry has its name in both. */
import en from '$messages/en/pages.json'
import codes from '$messages/zh/codes.json'
import { CHANNELS, FAULTS, FLAGS, PARAMETERS } from '$generated/registry'
import { expect, it } from 'vitest'
import { clock, Locale } from './locale.svelte'

type Catalogue = Record<string, string>

const english = import.meta.glob<Catalogue>('../../../messages/en/*.json', {
  eager: true,
  import: 'default',
})
const chinese = import.meta.glob<Catalogue>('../../../messages/zh/*.json', {
  eager: true,
  import: 'default',
})
const holes = (words: string) => [...words.matchAll(/\{(\w+)\}/g)].map((m) => m[1]).sort()

it.each(Object.entries(english))('%s uses the same keys and values in Chinese', (path, words) => {
  const translated = chinese[path.replace('/en/', '/zh/')] ?? {}
  // The server's own sentence stands for values that only its translation has to name.
  const compared = (key: string, text: string) =>
    words[key] === '{sentence}' ? [key] : [key, ...holes(text)]
  const of = (catalogue: Catalogue) =>
    Object.entries(catalogue).map(([key, text]) => compared(key, text))

  expect(of(translated)).toEqual(of(words))
})

it('has a translation of every fault, for riders and for mechanics', () => {
  const names = Object.keys(FAULTS).sort()

  expect(Object.keys(codes.fault).sort()).toEqual(names)
  expect(Object.keys(codes.mechanic).sort()).toEqual(names)
})

it('names every parameter, channel and flag the registry has today', () => {
  const flags = Object.keys(FLAGS.limit_flags).map((name) => `limit.${name}`)
  const faults = Object.keys(FLAGS.fault_flags).map((name) => `fault_flag.${name}`)
  const parameters = Object.keys(PARAMETERS).map((name) => `parameter.${name}`)

  const channels = Object.keys(CHANNELS).map((name) => `channel.${name}`)

  const unnamed = [...flags, ...faults, ...parameters, ...channels].filter((key) => !(key in en))

  expect(parameters.length).toBeGreaterThan(0)
  expect(unnamed).toEqual([])
})

it('shows a missing number as a dash, never as zero', () => {
  const locale = new Locale()

  expect([locale.number(null), locale.number(NaN), locale.number(0)]).toEqual(['—', '—', '0'])
})

it('rounds no share up to 100 %', () => {
  const locale = new Locale()

  expect([locale.share(0.99995), locale.share(1)]).toEqual(['99.9', '100.0'])
})

it("states the server's findings in Chinese with the numbers of the English", async () => {
  const values = { market: '日本', speed_kmh: 24 }
  const locale = new Locale()
  const sentence = () =>
    locale.translated('lint', 'cutoff_above_market', 'as the server says it', values)

  expect(sentence()).toBe('as the server says it')
  await locale.speak('zh')
  expect(sentence()).toContain('（日本）')
  expect(sentence()).toContain('24 km/h')
})

it('writes durations as a clock', () => {
  expect([clock(59), clock(3600), clock(7325)]).toEqual(['0:59', '1:00:00', '2:02:05'])
})

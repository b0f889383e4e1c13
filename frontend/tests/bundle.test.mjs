/* Goal: pages stay light. Budgets in kB gzip, from design measurements; no file may name another
   host to load from. Runs on dist/, which `npm run build` makes. */
import { existsSync, readdirSync, readFileSync } from 'node:fs'
import { gzipSync } from 'node:zlib'
import { describe, expect, it } from 'vitest'

const folder = 'dist/assets'
const built = existsSync(folder)
const files = built ? readdirSync(folder).filter((name) => /\.(js|css)$/.test(name)) : []
const kb = (names) =>
  names.reduce((sum, name) => sum + gzipSync(readFileSync(`${folder}/${name}`)).length, 0) / 1000
const lines = files.filter((name) => name.startsWith('plotly_lines'))
// uPlot's chunk is named after whatever module the bundler met first; its class names give it away.
const strips = files.filter((name) => readFileSync(`${folder}/${name}`, 'utf8').includes('u-over'))
const charts = [...lines, ...strips]
const chinese = files.filter((name) => /^zh-(pages|codes)-/.test(name))
const pages = files.filter((name) => /^\w+Page-.*js$/.test(name))

// What the page names itself, and then what those files import before they run.
const entry = () =>
  [...readFileSync('dist/index.html', 'utf8').matchAll(/assets\/([\w.-]+\.js)/g)].map((m) => m[1])
const all = (pattern) => files.filter((name) => pattern.test(name))
function loaded(names) {
  const found = new Set(names)
  for (const name of found) {
    const text = readFileSync(`${folder}/${name}`, 'utf8')
    for (const [, imported] of text.matchAll(/(?:from|import)\s*["']\.\/([\w.-]+\.js)["']/g)) {
      found.add(imported)
    }
  }
  return [...found]
}

describe.skipIf(!built)('the built pages', () => {
  // Style sheets are named after the chunk that they come with.
  const withStyles = (names) => {
    const stems = names.map((name) => name.replace(/-[\w-]{8}\.js$/, ''))
    const ofThem = (name) => stems.includes(name.replace(/-[\w-]{8}\.css$/, ''))
    return [...names, ...files.filter(ofThem)]
  }
  const first = () => withStyles(loaded([...entry(), ...all(/^BikePage-.*js$/)]))

  it('load their first page within 80 kB', () => {
    expect(kb(first())).toBeLessThan(80)
  })

  it.each(pages)('add at most 25 kB for %s, charts apart', (page) => {
    const before = [...first(), ...charts]
    const own = withStyles(loaded([page])).filter((name) => !before.includes(name))

    expect(kb(own)).toBeLessThan(25)
  })

  it('have the words of another language only for who reads it, within 25 kB', () => {
    expect(chinese.length).toBeGreaterThan(0)
    expect(kb(chinese)).toBeLessThan(25)
  })

  it('carry no other language for who reads English', () => {
    const foreign = files.filter(
      (name) =>
        !/^(zh|plotly_lines)-/.test(name) &&
        /[\u4e00-\u9fff]{4}/.test(readFileSync(`${folder}/${name}`, 'utf8')),
    )

    expect(foreign).toEqual([])
  })

  it('have line charts within 380 kB and live strips within 30, both on request', () => {
    expect(lines.length).toBeGreaterThan(0)
    expect(kb(lines)).toBeLessThan(380)
    expect(kb(strips)).toBeLessThan(30)
    expect(loaded(entry()).join()).not.toContain('plotly')
  })

  it('load no scripts, styles or fonts from other hosts', () => {
    expect(readFileSync('dist/index.html', 'utf8')).not.toMatch(/(src|href)="(https?:)?\/\//)
    for (const name of files.filter((file) => file.endsWith('.css'))) {
      expect(readFileSync(`${folder}/${name}`, 'utf8')).not.toMatch(/url\((["']?)(https?:)?\/\//)
    }
  })
})

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
const surface = files.filter((name) => name.startsWith('plotly_surface'))
const heatmap = files.filter((name) => name.startsWith('plotly_heatmap'))
// uPlot's chunk is named after whatever module the bundler met first; its class names give it away.
const strips = files.filter((name) => readFileSync(`${folder}/${name}`, 'utf8').includes('u-over'))
const charts = [...lines, ...surface, ...heatmap, ...strips]

describe.skipIf(!built)('the built pages', () => {
  it('have a shell and all pages without charts within 120 kB, first page within 80 kB', () => {
    const first = files.filter((name) => /^(index|BikePage|parameter_text|registry)-/.test(name))

    expect(kb(first)).toBeLessThan(80)
    expect(kb(files.filter((name) => !charts.includes(name)))).toBeLessThan(120)
  })

  it('have line charts within 380 kB, heatmaps within 20 more and live strips within 30', () => {
    expect(lines.length).toBeGreaterThan(0)
    expect(kb(lines)).toBeLessThan(380)
    expect(kb(heatmap)).toBeLessThan(20)
    expect(kb(strips)).toBeLessThan(30)
  })

  it('load three dimensions only on request, within 170 kB', () => {
    const entry = readFileSync('dist/index.html', 'utf8')

    expect(kb(surface)).toBeLessThan(170)
    expect(entry).not.toContain('plotly')
  })

  it('ask nobody else for scripts, styles or fonts', () => {
    expect(readFileSync('dist/index.html', 'utf8')).not.toMatch(/(src|href)="(https?:)?\/\//)
    for (const name of files.filter((file) => file.endsWith('.css'))) {
      expect(readFileSync(`${folder}/${name}`, 'utf8')).not.toMatch(/url\((["']?)(https?:)?\/\//)
    }
  })
})

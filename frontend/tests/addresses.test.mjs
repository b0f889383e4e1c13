/* Goal: no page uses an address from the root of the site: a proxy may have put the server below a
   path. `$shared/api/place` shows how they are built.
   Method: links and moves in the sources. The client of the API has its own base. */
import { readdirSync, readFileSync } from 'node:fs'
import { expect, it } from 'vitest'

const FROM_THE_ROOT = /href="\/|(?:go|assign|fetch)\(['"`]\/|['"`]\/(?:rides|tune|sign-in)\b/

const sources = readdirSync('src', { recursive: true, withFileTypes: true })
  .filter((file) => /\.(svelte|ts)$/.test(file.name) && !/\.test\.ts$/.test(file.name))
  .map((file) => `${file.parentPath}/${file.name}`)

it('no page uses an address from the root of the site', () => {
  const found = sources.filter((file) => FROM_THE_ROOT.test(readFileSync(file, 'utf8')))

  expect(found).toEqual([])
})

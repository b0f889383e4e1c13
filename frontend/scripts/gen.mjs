// Types of the API from the server's own description. `--check` only says whether they are fresh.
import { spawnSync } from 'node:child_process'
import { existsSync, readFileSync, writeFileSync } from 'node:fs'
import { fileURLToPath } from 'node:url'
import openapiTS, { astToString } from 'openapi-typescript'

const root = fileURLToPath(new URL('../..', import.meta.url))
const target = new URL('../src/generated/api.d.ts', import.meta.url)
const venv = ['.venv/bin/python', '.venv/Scripts/python.exe'].map((path) => root + path)
const python = process.env.SPINDLE_PYTHON ?? venv.find(existsSync) ?? 'python3'

const description = spawnSync(python, ['-m', 'backend.app'], {
  cwd: root,
  encoding: 'utf8',
  maxBuffer: 1 << 26,
})
if (description.status !== 0) {
  console.error(description.stderr)
  process.exit(1)
}
const types = astToString(await openapiTS(JSON.parse(description.stdout)))
const text = `// Generated from the API's description by \`npm run gen\`; do not edit.\n\n${types}`
if (!process.argv.includes('--check')) writeFileSync(target, text)
else if (!existsSync(target) || readFileSync(target, 'utf8') !== text) {
  console.error('src/generated/api.d.ts is not what the API says now: run `npm run gen`.')
  process.exit(1)
}

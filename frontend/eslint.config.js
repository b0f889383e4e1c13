// House rules a tool can hold. The zones: shared -> features -> app; a feature knows those of
// FEATURES only, a folder of shared those of SHARED; fetch and WebSocket live in shared only.
import js from '@eslint/js'
import svelte from 'eslint-plugin-svelte'
import globals from 'globals'
import { readdirSync } from 'node:fs'
import ts from 'typescript-eslint'
import svelteConfig from './svelte.config.js'

// Each folder of src/shared with the folders it may import. It names only folders above it, so that
// there is no circle.
const SHARED = {
  api: [],
  stream: [],
  ui: [],
  i18n: ['api'],
  units: ['i18n'],
  context: ['api', 'i18n', 'ui', 'units'],
  charts: ['api', 'context', 'i18n', 'stream', 'ui', 'units'],
  device: ['api', 'context', 'i18n', 'stream', 'ui', 'units'],
  limit_proof: ['api', 'context', 'i18n', 'ui', 'units'],
  fields: ['context', 'i18n', 'units'],
  config: ['api', 'context', 'device', 'fields', 'i18n', 'limit_proof', 'ui', 'units'],
  lint: ['api', 'config', 'context', 'i18n', 'ui', 'units'],
}

// The same of the features, which have the names of the backend's; none imports a page above it.
const FEATURES = {
  help: [],
  audit: [],
  people: [],
  bikes: [],
  units: [],
  imports: [],
  tuning: [],
  calibration: [],
  service: [],
  rides: ['imports'],
  settings: ['people'],
}

// The same of the rooms of the calibration wizard.
const WIZARD = {
  job: [],
  words: ['job'],
  results: ['job', 'words'],
  steps: ['results', 'job', 'words'],
  certificate: ['results', 'job', 'steps', 'words'],
}

const zone = (message, ...regexes) => [
  'error',
  { patterns: regexes.map((regex) => ({ regex, message })) },
]

/** One zone for each folder of `home`; throws where `rooms` is not what is there. begins: how an
    import of one of them begins. */
function zonesOf(home, rooms, begins, ...more) {
  const entries = Object.entries(rooms)
  const there = readdirSync(new URL(home, import.meta.url), { withFileTypes: true })
  const folders = there.flatMap((one) => (one.isDirectory() ? [one.name] : [])).sort()
  if (folders.join() !== Object.keys(rooms).sort().join()) {
    throw new Error(`${home} holds ${folders}: eslint.config.js names others`)
  }
  return entries.map(([folder, known], i) => {
    const later = known.find((name) => entries.findIndex(([other]) => other === name) >= i)
    if (later) throw new Error(`${folder} may not know ${later}, which stands below it`)
    const may = known.join(', ') || 'no other folder'
    const outside = `^(${begins})(?!(${[folder, ...known].join('|')})/|words$)`
    return {
      files: [`${home}/${folder}/**`],
      rules: {
        'no-restricted-imports': zone(`of ${home}, ${folder} knows ${may}`, outside, ...more),
      },
    }
  })
}

export default ts.config(
  { ignores: ['dist/', 'node_modules/', 'src/generated/'] },
  js.configs.recommended,
  ...ts.configs.strict,
  ...svelte.configs.recommended,
  {
    languageOptions: { globals: { ...globals.browser, ...globals.node } },
    rules: {
      'max-lines': ['error', 500],
      'max-lines-per-function': ['error', 70],
      'no-console': 'error',
      'no-warning-comments': 'error',
      'no-undef': 'off',
      eqeqeq: ['error', 'always', { null: 'ignore' }],
      '@typescript-eslint/no-non-null-assertion': 'error',
      'svelte/no-navigation-without-resolve': 'off',
    },
  },
  {
    files: ['**/*.svelte', '**/*.svelte.ts'],
    languageOptions: { parserOptions: { parser: ts.parser, svelteConfig } },
    rules: {
      'no-restricted-syntax': [
        'error',
        {
          selector: 'SvelteAttribute[key.name="type"] SvelteLiteral[value="number"]',
          message:
            'A browser\'s own turns under a mouse wheel and drops a comma: use NumberField of shared/fields.',
        },
      ],
    },
  },
  { files: ['scripts/*.mjs'], rules: { 'no-console': 'off' } },
  { files: ['**/*.test.{ts,mjs}'], rules: { 'max-lines-per-function': 'off' } },
  zonesOf('src/shared', SHARED, '\\.\\./|\\$shared/'),
  {
    files: ['src/features/**'],
    rules: {
      'no-restricted-globals': [
        'error',
        { name: 'fetch', message: 'use $shared/api' },
        { name: 'WebSocket', message: 'use $shared/stream' },
        { name: 'XMLHttpRequest', message: 'use $shared/api' },
      ],
    },
  },
  zonesOf('src/features', FEATURES, '\\.\\./', '/(features|app)/'),
  zonesOf('src/features/calibration/wizard', WIZARD, '\\.\\./', '/(features|app)/'),
)

// House rules a tool can hold. The zones: shared -> features -> app; no feature knows a feature;
// fetch and WebSocket live in shared only.
import js from '@eslint/js'
import svelte from 'eslint-plugin-svelte'
import globals from 'globals'
import ts from 'typescript-eslint'
import svelteConfig from './svelte.config.js'

const zone = (message, ...regexes) => [
  'error',
  { patterns: regexes.map((regex) => ({ regex, message })) },
]

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
  },
  { files: ['scripts/*.mjs'], rules: { 'no-console': 'off' } },
  { files: ['**/*.test.{ts,mjs}'], rules: { 'max-lines-per-function': 'off' } },
  {
    files: ['src/shared/**'],
    rules: {
      'no-restricted-imports': zone('shared knows neither features nor app', '/(features|app)/'),
    },
  },
  {
    files: ['src/features/**'],
    rules: {
      'no-restricted-imports': zone(
        'a feature imports its own files (./) and $shared; never app or another feature',
        '^\\.\\./',
        '/(features|app)/',
      ),
      'no-restricted-globals': [
        'error',
        { name: 'fetch', message: 'use $shared/api' },
        { name: 'WebSocket', message: 'use $shared/stream' },
        { name: 'XMLHttpRequest', message: 'use $shared/api' },
      ],
    },
  },
)

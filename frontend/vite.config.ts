import { svelte } from '@sveltejs/vite-plugin-svelte'
import { fileURLToPath } from 'node:url'
import { defineConfig } from 'vitest/config'

const folder = (path: string) => fileURLToPath(new URL(path, import.meta.url))
const server = process.env.SPINDLE_ORIGIN ?? 'http://127.0.0.1:8750'

// What most pages need in one file, and pages of a kind in another: dozens of tiny ones compress
// worse than they save.
const MOST = [
  'api/(?!bike_s|origin_r|pair_of|passkey_s|people_s|upload|visit_s|workbench)',
  'context/(?!KeyList|words)',
  'device/(?!FaultMoment|fault_moment|words)|stream/(?!polled)|ui/(?!Account|Alone)|units',
  'charts/(traces/plotly\\.ts|plot_axis\\.ts|[Ss]park)',
  'config/(config_draft|drafts|elements|stored_drafts|limits|page_draft|parameter_text)',
  'config/(ratchet|trial|two_tables)',
  'i18n/(?!channel_name)',
]
// What Tune shows on request.
const LATER = ['[Rr]escale', 'Scale', 'surface/(between|box|solid|words|Slice|Surface[MSV])']
// What the page of a unit and that of a visit both have, and what comes after the first.
const OF_VISITS = 'words|checks|SheetFaults'
const AFTER_SERVICE =
  'Guide|guide_w|OnSheet|on_sheet|Re(st|vis)|restored|Since|Job|Parts|Photos|Visit|Cons|Sig|unit_of'
const ON_REQUEST = 'logbook/(GiveToBike|ManyRides|Standing)'
const OTHER_RIDES = ['ride/', 'insight/', 'comparison/', 'replay/', ON_REQUEST]
const REVIEW = ['ReviewDialog', 'review_', 'words', 'TokenSteps', 'UnlockPanel', 'Write', 'write_']
const chunk = (name: string, pattern: string) => ({ name, test: new RegExp(`src/${pattern}`) })
// Catalogues of another language are files of their own: only who reads them fetches them.
const chunkName = ({ moduleIds }: { moduleIds: string[] }) =>
  moduleIds.some((id) => id.includes('/messages/zh/'))
    ? 'assets/zh-[name]-[hash].js'
    : 'assets/[name]-[hash].js'
const GROUPS = [
  chunk('unit', `shared/(${MOST.join('|')})`),
  chunk('fields', 'shared/(fields/(?!NumbersF)|config/ParameterForm)'),
  chunk('moment', 'shared/device/(FaultMoment|fault_moment|words)'),
  chunk('traces', 'shared/charts/traces/(Traces|SeriesT|ZoomB|trace_line|trace_window|ride_view)'),
  chunk('apart', 'shared/config/(SettingsDifference|SmallTable)'),
  chunk('rides', `features/(imports/(?!Table|table)|rides/(?!${OTHER_RIDES.join('|')}))`),
  chunk('replay', 'features/rides/replay/(?!proposals)'),
  chunk('ride', 'features/rides/ride/(?!from_file/|doubts/)'),
  chunk('comparison', 'features/rides/comparison/'),
  chunk('insight', 'features/rides/insight'),
  chunk('visits', 'shared/api/visit_s'),
  chunk('checks', `features/service/(${OF_VISITS})`),
  chunk('service', `features/service/(?!${OF_VISITS}|${AFTER_SERVICE})`),
  chunk('register', 'shared/api/(bike_server|people_server)|features/bikes/pairing/code'),
  chunk('bikes', 'features/bikes/(?!pairing)'),
  chunk('passkeys', 'shared/api/passkey_server|features/people/(authenticator|passkey_words)'),
  chunk('settings', 'features/(settings|people/(People|Keys|Passkeys))'),
  chunk('review', `shared/(limit_proof|config/(${REVIEW.join('|')}))`),
  chunk('config', 'shared/(config/(?!DraftNotes|draft_words|words|ParameterForm)|lint)'),
  chunk('tune', `features/tuning/table/(?!${LATER.join('|')})`),
]

export default defineConfig({
  plugins: [svelte()],
  // Files are found from the page's <base>, wherever a proxy has put the server.
  base: './',
  define: { global: 'globalThis' },
  resolve: {
    alias: {
      $shared: folder('./src/shared'),
      $generated: folder('./src/generated'),
      $messages: folder('./messages'),
      // Tests run in Node and would otherwise get the client for Node.
      'tus-js-client': folder('./node_modules/tus-js-client/lib.esm/browser/index.js'),
      // plotly's core imports the style sheet of a map engine that we never draw with.
      'maplibre-gl/dist/maplibre-gl.css': folder('./src/shared/charts/traces/no_map.css'),
    },
    // Components run in the tests' DOM, not on a server.
    conditions: process.env.VITEST ? ['browser'] : undefined,
  },
  json: { namedExports: false },
  build: {
    target: 'es2022',
    chunkSizeWarningLimit: 1500,
    modulePreload: { polyfill: false },
    rolldownOptions: { output: { chunkFileNames: chunkName, codeSplitting: { groups: GROUPS } } },
  },
  server: {
    host: '127.0.0.1',
    // With the Host the browser names: the server takes no request whose Origin is another's.
    proxy: { '/api': { target: server, ws: true, changeOrigin: false } },
  },
  test: {
    // Most tests are of plain values; one that needs a page says so in its first line.
    environment: 'node',
    // One process for all files, always in the same order: starting one for each took ten times as
    // long as the tests.
    isolate: false,
    fileParallelism: false,
    cache: false,
    include: ['src/**/*.test.ts', 'tests/**/*.test.mjs'],
  },
})

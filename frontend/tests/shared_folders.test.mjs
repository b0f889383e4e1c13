/* Goal: the folders of src/shared, and the rooms of the wizard, know each other one way only, and
   eslint is what holds it.
   Method: an import that goes the wrong way is planted in a file that is not there, and linted as
   `npm run lint` would; one that goes the right way passes. */
// @vitest-environment node
import { ESLint } from 'eslint'
import { beforeAll, expect, it } from 'vitest'

const eslint = new ESLint()
const LOADING_MS_MAX = 60_000 // TypeScript and Svelte come with the rules

beforeAll(() => eslint.calculateConfigForFile('src/shared/ui/planted.ts'), LOADING_MS_MAX)

async function complaints(file, imported) {
  const [result] = await eslint.lintText(`import '${imported}'\n`, { filePath: file })
  return result.messages.map((message) => message.ruleId)
}

it.each([
  ['ui', '../context/app_context'],
  ['ui', '../i18n/locale.svelte'],
  ['api', '../device/fault_text'],
  ['context', '../device/fault_text'],
  ['device', '../config/config_draft.svelte'],
  ['device', '$shared/config/config_draft.svelte'],
  ['config', '../../features/tuning/table/table'],
])('%s does not import %s', async (folder, imported) => {
  expect(await complaints(`src/shared/${folder}/planted.ts`, imported)).toEqual([
    'no-restricted-imports',
  ])
})

it('a feature knows another one way only', async () => {
  const known = '../imports/ImportPanel.svelte'

  expect(await complaints('src/features/rides/planted.ts', known)).toEqual([])
  expect(await complaints('src/features/tuning/planted.ts', known)).not.toEqual([])
})

it('the rooms of the wizard know each other one way', async () => {
  const wizard = 'src/features/calibration/wizard'

  expect(await complaints(`${wizard}/results/planted.ts`, '../steps/instruction')).not.toEqual([])
  expect(await complaints(`${wizard}/results/planted.ts`, '../../zero')).not.toEqual([])
  expect(await complaints(`${wizard}/steps/planted.ts`, '../results/figures')).toEqual([])
})

it('a folder imports what stands above it, and its own files', async () => {
  const file = 'src/shared/config/planted.ts'

  expect(await complaints(file, '../device/fault_text')).toEqual([])
  expect(await complaints(file, './limits')).toEqual([])
})

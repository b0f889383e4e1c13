// The page of who is not signed in, and the menu of who is; others never load either.
import type { Http } from '$shared/api/client'
import type { Person } from '$shared/api/people_server'
import type { Locale } from '$shared/i18n/locale.svelte'
import { mount } from 'svelte'

const page = () => import('./SignInPage.svelte')
const menu = () => import('./PersonMenu.svelte')

/** The page in the full window, or somebody's menu at the end of the shell's top. */
export async function show(person: Person | null, http: Http, locale: Locale): Promise<void> {
  // Their catalogues check it when they load.
  document.documentElement.lang = locale.language === 'zh' ? 'zh-CN' : 'en'
  const target = document.querySelector(person ? '.top' : '#app')
  if (!target) return
  if (person) mount((await menu()).default, { target, props: { person, http, locale } })
  else mount((await page()).default, { target, props: { http, locale } })
}

// The page of who is not signed in, and the menu of who is; others never load either.
import type { Http } from '$shared/api/client'
import type { Locale } from '$shared/i18n/locale.svelte'
import { mount } from 'svelte'

const page = () => import('./SignInPage.svelte')
const menu = () => import('./PersonMenu.svelte')

/** The page in the full window, or the menu at the end of the shell's top. */
export async function show(alone: boolean, http: Http, locale: Locale): Promise<void> {
  // Their catalogues check it when they load.
  document.documentElement.lang = locale.language === 'zh' ? 'zh-CN' : 'en'
  const { default: Shown } = await (alone ? page() : menu())
  const target = document.querySelector(alone ? '#app' : '.top')
  if (target) mount(Shown, { target, props: { http, locale } })
}

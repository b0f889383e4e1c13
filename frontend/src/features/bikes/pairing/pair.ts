// The page on which a code makes a bike somebody's. It stands alone: who opens it may be new here.
import type { Http } from '$shared/api/client'
import type { Locale } from '$shared/i18n/locale.svelte'
import { mount } from 'svelte'

export async function show(http: Http, locale: Locale): Promise<void> {
  // Its catalogue checks it when it loads.
  document.documentElement.lang = locale.language === 'zh' ? 'zh-CN' : 'en'
  const { default: PairPage } = await import('./PairPage.svelte')
  const target = document.getElementById('app')
  if (target) mount(PairPage, { target, props: { http, locale } })
}

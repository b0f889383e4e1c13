// The words of signing in and of the person's menu. They come with them.
import type { Values } from '$shared/i18n/locale.svelte'
import { pageWords } from '$shared/i18n/page_words.svelte'

export const en = {
  title: 'Sign in',
  name: 'Name',
  password: 'Password',
  sign_in: 'Sign in',
  signing_in: 'Signing in …',
  lost: 'Lost your password? An administrator gives you another one, in Settings or with',
  first_title: 'The first administrator',
  first_note:
    'This link works once. Choose your name, as it will stand beside your changes, and a ' +
    'password of at least 8 characters; a sentence is good.',
  first: 'Begin',
  needs_first:
    'There is no administrator yet. The server printed a link when it started: open that one.',
  wait: 'Too many wrong passwords. Wait {seconds} s, then try again.',
  nothing_yours: 'You are signed in as {name}.',
  nothing_yours_note:
    'Nothing here is yours yet: riders see their own bikes and rides, and none is registered to ' +
    'you. Ask your dealer.',
  sign_out: 'Sign out',
  person: '{initials}, signed in as {name}',
  settings: 'Password and account',
  role_rider: 'Rider',
  role_dealer: 'Dealer',
  role_engineer: 'Engineer',
  role_admin: 'Administrator',
}

export type SignInKey = keyof typeof en
export type Say = (key: SignInKey, values?: Values) => string

export const signInWords = await pageWords(en, async () => (await import('./words_zh')).zh)

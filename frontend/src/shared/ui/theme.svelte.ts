// Light, dark or as the system has it; charts get here the colours the style sheet gives.

export type ThemeChoice = 'system' | 'light' | 'dark'

export class Theme {
  choice = $state<ThemeChoice>('system')
  private system_dark = $state(false)
  dark = $derived(this.choice === 'dark' || (this.choice === 'system' && this.system_dark))

  constructor(choice: ThemeChoice) {
    this.choice = choice
    const query = matchMedia('(prefers-color-scheme: dark)')
    this.system_dark = query.matches
    query.addEventListener('change', (event) => (this.system_dark = event.matches))
  }

  /** Puts the theme on the document; call it again whenever `dark` changes. */
  apply(): void {
    document.documentElement.dataset.theme = this.dark ? 'dark' : 'light'
  }

  /** The value of a colour token now, such as `colour('rider')`. Reading it follows the theme. */
  colour(token: string): string {
    document.documentElement.dataset.theme = this.dark ? 'dark' : 'light'
    return getComputedStyle(document.documentElement).getPropertyValue(`--${token}`).trim()
  }
}

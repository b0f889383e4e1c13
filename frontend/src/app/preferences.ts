// What the reader chose, stored in this browser. Anything unreadable counts as not chosen.
import type { Language } from '$shared/i18n/locale.svelte'
import type { ThemeChoice } from '$shared/ui/theme.svelte'
import type { System } from '$shared/units/units.svelte'

export interface Preferences {
  language: Language
  theme: ThemeChoice
  units: System
  device_id: string | null
  author: string
  threshold_power_w: number | null
  heart_rate_bpm_max: number | null
  /** As `FirstSteps` reads it. */
  first_steps: unknown
}

const KEY = 'spindle'
const languages: readonly Language[] = ['en', 'zh']
const themes: readonly ThemeChoice[] = ['system', 'light', 'dark']
const systems: readonly System[] = ['metric', 'imperial']

export function readPreferences(): Preferences {
  const stored = parse(localStorage.getItem(KEY))
  const browser: Language = navigator.language.toLowerCase().startsWith('zh') ? 'zh' : 'en'
  return {
    language: oneOf(languages, stored.language) ?? browser,
    theme: oneOf(themes, stored.theme) ?? 'system',
    units: oneOf(systems, stored.units) ?? 'metric',
    device_id: typeof stored.device_id === 'string' ? stored.device_id : null,
    author: typeof stored.author === 'string' ? stored.author : '',
    threshold_power_w: positive(stored.threshold_power_w),
    heart_rate_bpm_max: positive(stored.heart_rate_bpm_max),
    first_steps: stored.first_steps,
  }
}

export function storePreferences(preferences: Preferences): void {
  localStorage.setItem(KEY, JSON.stringify(preferences))
}

function parse(text: string | null): Record<string, unknown> {
  try {
    const value: unknown = JSON.parse(text ?? '{}')
    return value && typeof value === 'object' ? (value as Record<string, unknown>) : {}
  } catch {
    return {}
  }
}

function oneOf<T>(choices: readonly T[], value: unknown): T | undefined {
  return choices.find((choice) => choice === value)
}

function positive(value: unknown): number | null {
  return typeof value === 'number' && value > 0 ? value : null
}

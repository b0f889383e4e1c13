// Events of the audit, a page at a time. Throws Refusal.
import type { components, operations } from '$generated/api'
import { body, type Http } from '$shared/api/client'

type Schemas = components['schemas']
export type AuditEvent = Schemas['AuditEvent']
export type AuditPage = Schemas['AuditPage']
export type ObjectKind = AuditEvent['object_kind']
/** Which events, as the server asks for it. */
export type Sought = Omit<
  NonNullable<operations['list_audit']['parameters']['query']>,
  'cursor' | 'limit'
>
export type ExportFormat = 'csv' | 'jsonl'

export function auditPage(http: Http, sought: Sought, cursor?: string): Promise<AuditPage> {
  const query = { ...sought, ...(cursor ? { cursor } : {}) }
  return body(http.GET('/api/v1/audit', { params: { query } }))
}

/** Where a file of these events is fetched, below the page's base. */
export function exportPath(sought: Sought, format: ExportFormat): string {
  const query = new URLSearchParams({ format })
  for (const [name, value] of Object.entries(sought)) {
    if (value != null) query.set(name, String(value))
  }
  return `api/v1/audit/export?${query}`
}

// A unit on the workbench. Loaded with the page that uses it. Throws Refusal.
import type { components } from '$generated/api'
import { body, type Http } from './client'

type Schemas = components['schemas']
export type UnitCheck = Schemas['UnitCheck']
export type UnitChecks = Schemas['UnitChecks']
export type SupportFile = Schemas['SupportFile']

export class WorkbenchServer {
  constructor(private readonly http: Http) {}

  private at(device_id: string) {
    return { params: { path: { device_id } } }
  }

  /** What can be checked of a unit without touching it, done now. */
  checks(id: string): Promise<UnitChecks> {
    return body(this.http.GET('/api/v1/devices/{device_id}/checks', this.at(id)))
  }

  /** What a unit says of itself, for who helps from afar. */
  supportFile(id: string): Promise<SupportFile> {
    return body(this.http.GET('/api/v1/devices/{device_id}/support', this.at(id)))
  }
}

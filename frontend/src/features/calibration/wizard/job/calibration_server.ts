// What the server does with a calibration, one function a verb; each answers with all of it.
import { body, type Http } from '$shared/api/client'
import type {
  CaptureRequest,
  Job,
  JobKind,
  JobSummary,
  Reading,
  SetupRequest,
  VerifyRequest,
} from './types'

export class CalibrationServer {
  constructor(private readonly http: Http) {}

  private at(calibration_id: number) {
    return { params: { path: { calibration_id } } }
  }

  async list(query: JobKind): Promise<JobSummary[]> {
    return (await body(this.http.GET('/api/v1/calibrations', { params: { query } }))).items
  }

  /** The open one of a unit, or a new one. */
  open(device_id: string): Promise<Job> {
    return body(this.http.POST('/api/v1/calibrations', { body: { device_id } }))
  }

  get(id: number): Promise<Job> {
    return body(this.http.GET('/api/v1/calibrations/{calibration_id}', this.at(id)))
  }

  reading(id: number): Promise<Reading> {
    return body(this.http.GET('/api/v1/calibrations/{calibration_id}/reading', this.at(id)))
  }

  setUp(id: number, setup: SetupRequest): Promise<Job> {
    const request = { ...this.at(id), body: setup }
    return body(this.http.PUT('/api/v1/calibrations/{calibration_id}/setup', request))
  }

  capture(id: number, state: CaptureRequest): Promise<Job> {
    const request = { ...this.at(id), body: state }
    return body(this.http.POST('/api/v1/calibrations/{calibration_id}/captures', request))
  }

  strike(calibration_id: number, number: number, reason: string): Promise<Job> {
    const params = { path: { calibration_id, number }, query: { reason } }
    const path = '/api/v1/calibrations/{calibration_id}/captures/{number}'
    return body(this.http.DELETE(path, { params }))
  }

  fit(id: number): Promise<Job> {
    return body(this.http.POST('/api/v1/calibrations/{calibration_id}/fit', this.at(id)))
  }

  /** token: the maker's, where a refusal requires it. */
  write(calibration_id: number, reason: string, token: string | null): Promise<Job> {
    const params = { path: { calibration_id }, query: { reason, token } }
    return body(this.http.POST('/api/v1/calibrations/{calibration_id}/write', { params }))
  }

  /** Writes back what the unit had before. */
  restore(calibration_id: number, reason: string, token: string | null): Promise<Job> {
    const params = { path: { calibration_id }, query: { reason, token } }
    return body(this.http.POST('/api/v1/calibrations/{calibration_id}/restore', { params }))
  }

  verify(id: number, load: VerifyRequest): Promise<Job> {
    const request = { ...this.at(id), body: load }
    return body(this.http.POST('/api/v1/calibrations/{calibration_id}/verify', request))
  }

  close(id: number): Promise<Job> {
    return body(this.http.POST('/api/v1/calibrations/{calibration_id}/close', this.at(id)))
  }
}

/** Where the certificate's file is. */
export function certificateAddress(id: number): string {
  return `api/v1/calibrations/${id}/certificate`
}

/** Its PDF, with moments of where the reader is. */
export function paperAddress(id: number, language: string): string {
  const zone = Intl.DateTimeFormat().resolvedOptions().timeZone || 'UTC'
  const request = new URLSearchParams({ language, zone })
  return `api/v1/calibrations/${id}/certificate.pdf?${request}`
}

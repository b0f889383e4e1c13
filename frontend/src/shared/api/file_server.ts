// What the server does with files that come in; sending them is `uploadFile`.
import { body, type Http } from './client'
import type {
  AnsweredTable,
  Ride,
  TableAnswerRequest,
  TableQuestion,
  Upload,
  UploadList,
} from './types'

export class FileServer {
  constructor(private readonly http: Http) {}

  private at(upload_id: string) {
    return { params: { path: { upload_id } } }
  }

  /** Where a file stands. */
  upload(id: string): Promise<Upload> {
    return body(this.http.GET('/api/v1/uploads/{upload_id}', this.at(id)))
  }

  /** A page of the files within a container. */
  parts(part_of: string, cursor?: string): Promise<UploadList> {
    return body(this.http.GET('/api/v1/uploads', { params: { query: { part_of, cursor: cursor ?? null } } }))
  }

  /** Removes a file that became no ride, and its bytes. */
  async remove(id: string): Promise<void> {
    await body(this.http.DELETE('/api/v1/uploads/{upload_id}', this.at(id)))
  }

  /** The questions about a table before it can be read. */
  tableQuestion(id: string): Promise<TableQuestion> {
    return body(this.http.GET('/api/v1/uploads/{upload_id}/mapping', this.at(id)))
  }

  /** Says it; what became of the file. */
  sayOfTable(id: string, answer: TableAnswerRequest): Promise<Upload> {
    return body(
      this.http.PUT('/api/v1/uploads/{upload_id}/mapping', { ...this.at(id), body: answer }),
    )
  }

  /** A simulated ride for a first look; made where it is not here yet. */
  sampleRide(): Promise<Ride> {
    return body(this.http.POST('/api/v1/rides/sample'))
  }

  /** The answers given about tables. */
  async answeredTables(): Promise<AnsweredTable[]> {
    return (await body(this.http.GET('/api/v1/tables'))).items
  }

  /** The next file with this header needs an answer again. */
  async forgetTable(header_sha256: string): Promise<void> {
    const params = { path: { header_sha256 } }
    await body(this.http.DELETE('/api/v1/tables/{header_sha256}', { params }))
  }
}

// The requests to Spindle's server, one function each. Throws Refusal.
import { body, bodyAndTag, type Http } from './client'
import { FileServer } from './file_server'
import { readSeries, type Series } from './series'
import type {
  AgainRequest,
  LimitProof,
  LimitProofRequest,
  ClosedLoop,
  ComparedSide,
  Comparison,
  Config,
  ConfigChange,
  Cut,
  Dashboard,
  Device,
  Fault,
  FaultMoment,
  Feel,
  FuzzyTable,
  Health,
  LastKnown,
  Ledger,
  RideDiagnosis,
  RideEffort,
  RideEnergy,
  RidePedalling,
  LibraryDocument,
  LibraryEntry,
  LibraryRow,
  Limits,
  LintReport,
  LintRequest,
  LogDownload,
  ModeCurves,
  Parameter,
  ParameterValue,
  Port,
  Proposal,
  ProposalRequest,
  ReadFis,
  Replay,
  ReplayRequest,
  Revision,
  Ride,
  RideKind,
  RideList,
  RideMark,
  RiderHome,
  Scenario,
  Simulation,
  SimulationChange,
  SensorDrift,
  SinceChange,
  Snapshot,
  StorePlace,
  Surface,
  TableUse,
  TableUseRequest,
  TorqueSurface,
  TorqueSurfaceRequest,
  Track,
  UnitLogs,
  Why,
  WhyRequest,
} from './types'

export class Server {
  /** What comes in as a file. */
  readonly files: FileServer

  constructor(readonly http: Http) {
    this.files = new FileServer(http)
  }

  private unit(device_id: string) {
    return { params: { path: { device_id } } }
  }

  private rideAt(ride_id: number) {
    return { params: { path: { ride_id } } }
  }

  /** Whether everything is being stored. */
  health(): Promise<Health> {
    return body(this.http.GET('/api/v1/health'))
  }

  /** Where all data is stored, and how large it is. */
  store(signal: AbortSignal): Promise<StorePlace> {
    return body(this.http.GET('/api/v1/store', { signal }))
  }

  async devices(): Promise<Device[]> {
    return (await body(this.http.GET('/api/v1/devices'))).items
  }

  async ports(): Promise<Port[]> {
    return (await body(this.http.GET('/api/v1/ports'))).items
  }

  connect(url: string): Promise<Device> {
    return body(this.http.POST('/api/v1/devices', { body: { url } }))
  }

  async disconnect(id: string): Promise<void> {
    await body(this.http.DELETE('/api/v1/devices/{device_id}', this.unit(id)))
  }

  async parameters(id: string): Promise<Parameter[]> {
    return (await body(this.http.GET('/api/v1/devices/{device_id}/parameters', this.unit(id))))
      .items
  }

  /** What the rider sees now. */
  dashboard(id: string): Promise<Dashboard> {
    return body(this.http.GET('/api/v1/devices/{device_id}/dashboard', this.unit(id)))
  }

  /** The configuration and its ETag. */
  config(id: string): Promise<[Config, string]> {
    return bodyAndTag(this.http.GET('/api/v1/devices/{device_id}/config', this.unit(id)))
  }

  /** Writes parameters; `tag` is the ETag of the configuration the change was made for. confirm_s:
      0 for good, else the unit returns after so many seconds unless it is confirmed. token: the
      maker's, where a refusal requires it. read_from: the key of the unit whose values these are.
      */
  writeConfig(
    id: string,
    parameters: Record<string, ParameterValue>,
    reason: string,
    tag: string,
    confirm_s = 0,
    token: string | null = null,
    read_from: string | null = null,
  ): Promise<[ConfigChange, string]> {
    return bodyAndTag(
      this.http.PATCH('/api/v1/devices/{device_id}/config', {
        params: { path: { device_id: id }, header: { 'if-match': tag } },
        body: { parameters, reason, confirm_s, token, read_from },
      }),
    )
  }

  /** Confirms what is on trial. */
  confirmConfig(id: string): Promise<ConfigChange> {
    return body(this.http.POST('/api/v1/devices/{device_id}/config/confirm', this.unit(id)))
  }

  /** Gives up what is on trial. */
  rollbackConfig(id: string): Promise<ConfigChange> {
    return body(this.http.POST('/api/v1/devices/{device_id}/config/rollback', this.unit(id)))
  }

  /** What the unit enforces, its market included, and where assist ends because of it. */
  async limits(id: string): Promise<Limits> {
    const at = { params: { path: { device_id: id, part: 'limits' as const } } }
    return (await body(this.http.GET('/api/v1/devices/{device_id}/parts/{part}', at))) as Limits
  }

  /** What the unit was last known to be set to, connected or not. */
  lastKnown(id: string): Promise<LastKnown> {
    return body(this.http.GET('/api/v1/devices/{device_id}/last-known', this.unit(id)))
  }

  async revisions(id: string): Promise<Revision[]> {
    return (
      await body(this.http.GET('/api/v1/devices/{device_id}/config/revisions', this.unit(id)))
    ).items
  }

  /** The unit's rides since a configuration of its history, against those before it. */
  sinceRevision(id: string, seq: number, signal: AbortSignal): Promise<SinceChange> {
    const params = { path: { device_id: id, seq } }
    const path = '/api/v1/devices/{device_id}/config/revisions/{seq}/since'
    return body(this.http.GET(path, { params, signal }))
  }

  /** The zero of the unit's torque sensor over its rides, of which the newest are listed. */
  sensorDrift(id: string, signal: AbortSignal, rides = 1000): Promise<SensorDrift> {
    const params = { path: { device_id: id }, query: { rides } }
    return body(this.http.GET('/api/v1/devices/{device_id}/sensor-drift', { params, signal }))
  }

  async channels(id: string): Promise<Record<string, number | null>> {
    return (await this.snapshot(id)).channels
  }

  /** The newest value of every channel, and when it was. */
  snapshot(id: string): Promise<Snapshot> {
    return body(this.http.GET('/api/v1/devices/{device_id}/snapshot', this.unit(id)))
  }

  async faults(id: string): Promise<Fault[]> {
    return (await body(this.http.GET('/api/v1/devices/{device_id}/faults', this.unit(id)))).items
  }

  /** What the bike did around a fault, from its ride or the last minutes of the stream. */
  faultMoment(device_id: string, fault_name: string, signal: AbortSignal): Promise<FaultMoment> {
    const params = { path: { device_id, fault_name } }
    const path = '/api/v1/devices/{device_id}/faults/{fault_name}/moment'
    return body(this.http.GET(path, { params, signal }))
  }

  /** Forgets the faults that are over; what is left. */
  async clearFaults(id: string): Promise<Fault[]> {
    const request = this.http.POST('/api/v1/devices/{device_id}/faults/clear', this.unit(id))
    return (await body(request)).items
  }

  /** Marks the newest moment of the ride that a unit is recorded on. */
  mark(id: string): Promise<RideMark> {
    return body(this.http.POST('/api/v1/devices/{device_id}/marks', this.unit(id)))
  }

  /** How far and how long the unit ran, and how its flash is. */
  /** The rides in the unit's own flash. */
  unitLogs(id: string): Promise<UnitLogs> {
    return body(this.http.GET('/api/v1/devices/{device_id}/logs', this.unit(id)))
  }

  /** Begins to fetch a ride from the unit, or goes on where an earlier try ended. */
  fetchLog(device_id: string, log_id: number): Promise<LogDownload> {
    const request = { params: { path: { device_id, log_id } } }
    return body(this.http.POST('/api/v1/devices/{device_id}/logs/{log_id}/download', request))
  }

  /** Frees a ride in the unit that was fetched and confirmed; the unit refuses any other. */
  async eraseLog(device_id: string, log_id: number): Promise<void> {
    const request = { params: { path: { device_id, log_id } } }
    await body(this.http.DELETE('/api/v1/devices/{device_id}/logs/{log_id}', request))
  }

  /** What a simulated unit can be sent on. */
  async scenarios(): Promise<Scenario[]> {
    return (await body(this.http.GET('/api/v1/scenarios'))).items
  }

  simulation(id: string): Promise<Simulation> {
    return body(this.http.GET('/api/v1/devices/{device_id}/simulation', this.unit(id)))
  }

  setSimulation(id: string, change: SimulationChange): Promise<Simulation> {
    return body(
      this.http.PUT('/api/v1/devices/{device_id}/simulation', { ...this.unit(id), body: change }),
    )
  }

  /** The gain surface of a table, computed by the unit's own law. */
  surface(
    fuzzy_table: FuzzyTable,
    speeds_kmh: number[],
    torque_rates: number[],
    signal: AbortSignal,
  ): Promise<Surface> {
    const request = { body: { fuzzy_table, speeds_kmh, torque_rates }, signal }
    return body(this.http.POST('/api/v1/surface', request))
  }

  /** What a steady push gets of a table for long, as the limits leave it, by the unit's own law. */
  torqueSurface(question: TorqueSurfaceRequest, signal: AbortSignal): Promise<TorqueSurface> {
    return body(this.http.POST('/api/v1/surface/torque', { body: question, signal }))
  }

  /** What each of the five modes gives for a steady push, by the unit's own law. */
  modeCurves(
    parameters: Record<string, ParameterValue>,
    rider_torque_nm: number,
    speeds_kmh: number[],
    signal: AbortSignal,
  ): Promise<ModeCurves> {
    const request = { body: { parameters, rider_torque_nm, speeds_kmh }, signal }
    return body(this.http.POST('/api/v1/modes/curves', request))
  }

  lint(question: LintRequest, signal: AbortSignal): Promise<LintReport> {
    return body(this.http.POST('/api/v1/lint', { body: question, signal }))
  }

  /** What is proven of every ride with a configuration. */
  proveLimits(question: LimitProofRequest, signal: AbortSignal): Promise<LimitProof> {
    return body(this.http.POST('/api/v1/certificates', { body: question, signal }))
  }

  /** Starts a search of settings for a wish; a job to be watched. */
  propose(question: ProposalRequest): Promise<Proposal> {
    return body(this.http.POST('/api/v1/proposals', { body: question }))
  }

  proposal(proposal_id: string): Promise<Proposal> {
    const request = { params: { path: { proposal_id } } }
    return body(this.http.GET('/api/v1/proposals/{proposal_id}', request))
  }

  cancelProposal(proposal_id: string): Promise<Proposal> {
    const request = { params: { path: { proposal_id } } }
    return body(this.http.DELETE('/api/v1/proposals/{proposal_id}', request))
  }

  /** Where in a table a unit's latest rides were. */
  tableUse(question: TableUseRequest, signal: AbortSignal): Promise<TableUse> {
    return body(this.http.POST('/api/v1/rides/table-use', { body: question, signal }))
  }

  /** The named tables and configurations, without their values. */
  async library(): Promise<LibraryRow[]> {
    return (await body(this.http.GET('/api/v1/library'))).items
  }

  /** version: of an own one, as it once was. */
  libraryEntry(entry_id: string, version?: number): Promise<LibraryEntry> {
    const query = version === undefined ? {} : { version }
    const request = { params: { path: { entry_id }, query } }
    return body(this.http.GET('/api/v1/library/{entry_id}', request))
  }

  /** Every state an own entry was in, newest first. */
  async libraryVersions(entry_id: string): Promise<LibraryRow[]> {
    const request = { params: { path: { entry_id } } }
    return (await body(this.http.GET('/api/v1/library/{entry_id}/versions', request))).items
  }

  /** How an entry feels on the simulated bike. */
  libraryFeel(entry_id: string): Promise<Feel> {
    const request = { params: { path: { entry_id } } }
    return body(this.http.GET('/api/v1/library/{entry_id}/feel', request))
  }

  addToLibrary(document: LibraryDocument): Promise<LibraryRow> {
    return body(this.http.POST('/api/v1/library', { body: document }))
  }

  /** tag: the ETag of what the change is made for. */
  changeInLibrary(entry_id: string, document: LibraryDocument, tag: string): Promise<LibraryRow> {
    const params = { path: { entry_id }, header: { 'if-match': tag } }
    return body(this.http.PUT('/api/v1/library/{entry_id}', { params, body: document }))
  }

  removeFromLibrary(entry_id: string, tag: string): Promise<LibraryRow> {
    const params = { path: { entry_id }, header: { 'if-match': tag } }
    return body(this.http.DELETE('/api/v1/library/{entry_id}', { params }))
  }

  /** The table in the text of a .fis file; nothing is stored. */
  readFis(text: string, name: string): Promise<ReadFis> {
    return body(this.http.POST('/api/v1/library/fis', { body: { text, name } }))
  }

  /** Two of anything side by side, with how they feel. */
  compare(
    left: ComparedSide,
    right: ComparedSide,
    signal: AbortSignal,
    feel = true,
  ): Promise<Comparison> {
    const question = { left: side(left), right: side(right), feel }
    return body(this.http.POST('/api/v1/library/compare', { body: question, signal }))
  }

  /** A page of rides, newest first; kind: which of them. */
  rides(cursor?: string, kind: RideKind = {}): Promise<RideList> {
    const query = { limit: 50, ...kind, ...(cursor ? { cursor } : {}) }
    return body(this.http.GET('/api/v1/rides', { params: { query } }))
  }

  /** Weeks, months, bikes, records and faults; zone: the rider's. */
  riderHome(zone: string, week_begins: number, bike?: number): Promise<RiderHome> {
    const query = { zone, week_begins, ...(bike ? { bike } : {}) }
    return body(this.http.GET('/api/v1/rides/home', { params: { query } }))
  }

  async tagRides(ride_ids: number[], change: { add?: string[]; remove?: string[] }) {
    const request = { body: { ride_ids, add: [], remove: [], ...change } }
    await body(this.http.POST('/api/v1/rides/tags', request))
  }

  async deleteRides(ride_ids: number[]): Promise<void> {
    await body(this.http.POST('/api/v1/rides/delete', { body: { ride_ids } }))
  }

  /** The newest rides of a unit, newest first. */
  async latestRides(unit_key: string, limit: number): Promise<Ride[]> {
    const query = { device: unit_key, limit }
    return (await body(this.http.GET('/api/v1/rides', { params: { query } }))).items
  }

  ride(id: number): Promise<Ride> {
    return body(this.http.GET('/api/v1/rides/{ride_id}', this.rideAt(id)))
  }

  /** What the motor would have done on a ride with other settings, by the unit's law. */
  replay(id: number, question: ReplayRequest, signal: AbortSignal): Promise<Replay> {
    const request = { ...this.rideAt(id), body: question, signal }
    return body(this.http.POST('/api/v1/rides/{ride_id}/replay', request))
  }

  /** The same road again with other settings, by a twin of the bike. */
  rideAgain(id: number, question: AgainRequest, signal: AbortSignal): Promise<ClosedLoop> {
    const request = { ...this.rideAt(id), body: question, signal }
    return body(this.http.POST('/api/v1/rides/{ride_id}/again', request))
  }

  /** Why the motor gave what it gave at a moment of a ride, by the unit's own law. */
  whyOfRide(id: number, t_s: number, signal: AbortSignal): Promise<Why> {
    const params = { ...this.rideAt(id).params, query: { t_s } }
    return body(this.http.GET('/api/v1/rides/{ride_id}/why', { params, signal }))
  }

  /** The same for a steady state, with a unit's configuration or the law's defaults. */
  whySteady(device_id: string | null, state: WhyRequest, signal: AbortSignal): Promise<Why> {
    const request = { body: state, signal }
    return device_id === null
      ? body(this.http.POST('/api/v1/why', request))
      : body(
          this.http.POST('/api/v1/devices/{device_id}/why', {
            ...request,
            ...this.unit(device_id),
          }),
        )
  }

  track(id: number, signal: AbortSignal): Promise<Track> {
    return body(this.http.GET('/api/v1/rides/{ride_id}/track', { ...this.rideAt(id), signal }))
  }

  /** Which mode and which rule carried which share of a ride's motor energy. */
  ledger(id: number): Promise<Ledger> {
    return body(this.http.GET('/api/v1/rides/{ride_id}/ledger', this.rideAt(id)))
  }

  /** Rider, motor and battery apart: of a ride, its modes and its gradients; charge and range. */
  energy(id: number, signal: AbortSignal): Promise<RideEnergy> {
    return body(this.http.GET('/api/v1/rides/{ride_id}/energy', { ...this.rideAt(id), signal }))
  }

  /** Zones, bands and best mean powers; zones only of limits that the rider set. */
  effort(
    id: number,
    rider: { threshold_power_w: number | null; heart_rate_bpm_max: number | null },
    signal: AbortSignal,
  ): Promise<RideEffort> {
    const params = { path: { ride_id: id }, query: rider }
    return body(this.http.GET('/api/v1/rides/{ride_id}/effort', { params, signal }))
  }

  /** Torque over the crank's angle, and time over speed and gain. */
  pedalling(id: number, signal: AbortSignal): Promise<RidePedalling> {
    return body(this.http.GET('/api/v1/rides/{ride_id}/pedalling', { ...this.rideAt(id), signal }))
  }

  /** What a ride shows of the bike's health. */
  diagnosis(id: number, signal: AbortSignal): Promise<RideDiagnosis> {
    return body(this.http.GET('/api/v1/rides/{ride_id}/diagnosis', { ...this.rideAt(id), signal }))
  }

  /** Where limits limited the motor on a ride, in order of time. */
  async cuts(id: number): Promise<Cut[]> {
    return (await body(this.http.GET('/api/v1/rides/{ride_id}/cuts', this.rideAt(id)))).items
  }

  changeRide(
    id: number,
    change: { name?: string; notes?: string; doubts_accepted?: boolean },
  ): Promise<Ride> {
    return body(this.http.PATCH('/api/v1/rides/{ride_id}', { ...this.rideAt(id), body: change }))
  }

  async deleteRide(id: number): Promise<void> {
    await body(this.http.DELETE('/api/v1/rides/{ride_id}', this.rideAt(id)))
  }

  /** Least and greatest value per bin, exact at any zoom. */
  async series(
    id: number,
    channels: string[],
    window: { from_s?: number; to_s?: number; px: number; axis?: Series['axis'] },
    signal: AbortSignal,
  ): Promise<Series> {
    const request = this.http.GET('/api/v1/rides/{ride_id}/series', {
      params: { path: { ride_id: id }, query: { channels: channels.join(','), ...window } },
      headers: { accept: 'application/octet-stream' },
      parseAs: 'arrayBuffer',
      signal,
    })
    return readSeries((await body(request)) as ArrayBuffer)
  }
}

function side(side_of_pair: ComparedSide) {
  return { table: 'first' as const, ...side_of_pair }
}

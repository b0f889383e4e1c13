// What the server makes of rolls, rides and climbs: the bike's other numbers.
import type { components } from '$generated/api'
import { body, type Http } from '$shared/api/client'

type Schemas = components['schemas']
export type MeasuredWheel = Schemas['Wheel']
export type PulseComparison = Schemas['PulseComparison']
export type CadenceCheck = Schemas['Cadence']
export type ClimbResult = Awaited<ReturnType<BikeServer['climb']>>
export type RollOut = Schemas['RollOut']
export type WheelByTrack = Schemas['WheelByTrack']
export type PulsesRequest = Schemas['PulsesRequest']
export type CadenceRequest = Schemas['CadenceRequest']
type ClimbRequest = Schemas['ClimbRequest']
/** What the page sends of a climb; the rest are the server's defaults. */
export type ClimbQuestion = Pick<
  ClimbRequest,
  'climb' | 'coast_downs' | 'mass_kg' | 'mass_limit_kg' | 'rise_limit_m' | 'motor_off'
>
export type Slope = Schemas['SlopeRidden']

export class BikeServer {
  constructor(private readonly http: Http) {}

  rolled(request: RollOut, signal: AbortSignal): Promise<MeasuredWheel> {
    return body(this.http.POST('/api/v1/calibration/wheel/roll-out', { body: request, signal }))
  }

  tracked(request: WheelByTrack, signal: AbortSignal): Promise<MeasuredWheel> {
    return body(this.http.POST('/api/v1/calibration/wheel/track', { body: request, signal }))
  }

  pulses(request: PulsesRequest, signal: AbortSignal): Promise<PulseComparison> {
    return body(this.http.POST('/api/v1/calibration/wheel/pulses', { body: request, signal }))
  }

  cadence(request: CadenceRequest, signal: AbortSignal): Promise<CadenceCheck> {
    return body(this.http.POST('/api/v1/calibration/cadence', { body: request, signal }))
  }

  climb(request: ClimbQuestion, signal: AbortSignal) {
    const question = request as ClimbRequest
    return body(this.http.POST('/api/v1/calibration/climb', { body: question, signal }))
  }
}

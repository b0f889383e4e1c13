// Short names for the schemas of a calibration.
import type { components, operations } from '$generated/api'

type Schemas = components['schemas']

export type Job = Schemas['Job']
export type JobSummary = Schemas['JobSummary']
export type Reading = Schemas['Reading']
export type Setup = Schemas['Setup']
export type SetupRequest = Schemas['SetupRequest']
export type CaptureRequest = Schemas['CaptureRequest']
export type VerifyRequest = Schemas['VerifyRequest']
export type CaptureSummary = Schemas['CaptureSummary']
export type Step = Schemas['Step']
export type State = Schemas['State']
export type Side = Schemas['VerifyRequest']['side']
export type Check = Schemas['Check']
export type Cause = Schemas['Cause']
export type Reason = Schemas['Refusal']
export type Worked = Schemas['Worked']
export type SideFigures = Schemas['SideFigures']
export type Budget = Schemas['Budget']
export type RecordLine = Schemas['RecordLine']
export type JobKind = NonNullable<operations['list_calibrations']['parameters']['query']>

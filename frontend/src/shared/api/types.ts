// Short names for what the server sends; the shapes are generated from its OpenAPI description.
import type { components } from '$generated/api'

type Schemas = components['schemas']

export type Device = Schemas['Device']
export type Port = Schemas['Port']
export type Simulation = Schemas['Simulation']
export type SimulationChange = Schemas['SimulationChange']
export type Parameter = Schemas['Parameter']
export type ParameterValue = Parameter['default']
export type Config = Schemas['Config']
export type ConfigChange = Schemas['ConfigChange']
export type Revision = Schemas['Revision']
export type FuzzyTable = Schemas['FuzzyTable']
export type RuleLabel = FuzzyTable['rules'][number][number]
export type Surface = Schemas['Surface']
export type LintReport = Schemas['LintReport']
export type Finding = Schemas['Finding']
export type Ride = Schemas['Ride']
export type Upload = Schemas['Upload']
export type FieldProblem = Schemas['FieldProblem']

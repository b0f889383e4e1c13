// Requests about two rides side by side. Loaded with the page that uses them. Throws Refusal.
import { body, type Http } from './client'
import type {
  ComparedCrank,
  ComparedPair,
  ComparedPart,
  ComparedSeries,
  RideComparison,
} from './types'

export class PairOfRides {
  constructor(private readonly http: Http) {}

  /** Figures, ways and settings of both. */
  figures(pair: ComparedPair, signal: AbortSignal): Promise<RideComparison> {
    return body(this.http.GET('/api/v1/rides/compare', { params: { query: pair }, signal }))
  }

  /** Both on one axis; channels and part of the axis as the query says. */
  series(query: ComparedPart, signal: AbortSignal): Promise<ComparedSeries> {
    return body(this.http.GET('/api/v1/rides/compare/series', { params: { query }, signal }))
  }

  /** Torque over the crank's angle of both. */
  crank(pair: ComparedPair, signal: AbortSignal): Promise<ComparedCrank> {
    return body(this.http.GET('/api/v1/rides/compare/crank', { params: { query: pair }, signal }))
  }
}

/* Goal: a search that is given up ends, also one whose name has not come yet, and no late answer
   brings it back. */
import type { Server } from '$shared/api/server'
import type { Proposal, ProposalRequest } from '$shared/api/types'
import { expect, it } from 'vitest'
import { ProposalJob } from './job.svelte'

const named = (state: string) => ({ id: 'seven', state }) as Proposal
const later = <T>() => {
  let settle: (value: T) => void = () => undefined
  const promise = new Promise<T>((resolve) => (settle = resolve))
  return { promise, settle }
}

it('is given up although its name came after the wish to end it', async () => {
  const answer = later<Proposal>()
  const cancelled: string[] = []
  const server = {
    propose: () => answer.promise,
    cancelProposal: (id: string) => (cancelled.push(id), Promise.resolve(named('cancelled'))),
  } as unknown as Server
  const job = new ProposalJob(server)

  const begun = job.begin({} as ProposalRequest)
  await job.cancel()
  answer.settle(named('waiting'))
  await begun

  expect(cancelled).toEqual(['seven'])
  expect([job.job?.state, job.running]).toEqual(['cancelled', false])
})

it('stays given up when an older poll is answered late', async () => {
  const poll = later<Proposal>()
  const server = {
    propose: () => Promise.resolve(named('riding')),
    proposal: () => poll.promise,
    cancelProposal: () => Promise.resolve(named('cancelled')),
  } as unknown as Server
  const job = new ProposalJob(server)
  await job.begin({} as ProposalRequest)
  await new Promise((soon) => setTimeout(soon, 500)) // the poll is on its way

  await job.cancel()
  poll.settle(named('riding'))
  await poll.promise

  expect(job.job?.state).toBe('cancelled')
})

/* Goal: the picture of the surface is what the law answered, in the requested unit, and says which
limit took what. */
import { expect, it } from 'vitest'
import type { TorqueSurface } from '$shared/api/types'
import { pictureOf, takers } from './surface_shown'

const MARKET = 0x4000
const CUTOFF = 0x0002
const torque: TorqueSurface = {
  speeds_kmh: [0, 10],
  torque_rates: [0, 0.5],
  demanded_nm: [
    [20, 60],
    [20, 60],
  ],
  delivered_nm: [
    [20, 40],
    [0, 0],
  ],
  limit_flags: [
    [0, MARKET],
    [CUTOFF, CUTOFF | MARKET],
  ],
  cadence_rpm: 60,
  crank_rad_per_s: 2 * Math.PI,
  engine: '',
}
const gain = { speeds_kmh: [0, 10], torque_rates: [0, 1], gain: [[0.1, 0.2]] }

it('shows the gain until the torque is known', () => {
  expect(pictureOf('delivered_nm', gain, null, 60)?.shown).toBe('gain')
  expect(pictureOf('delivered_nm', null, null, 60)).toBeNull()
})

it('shows what is delivered, what was demanded, and which limit took the rest', () => {
  const picture = pictureOf('delivered_nm', gain, torque, 60)

  expect(picture?.z).toEqual(torque.delivered_nm)
  expect(picture?.demanded).toEqual(torque.demanded_nm)
  expect(picture?.taken_by).toEqual([
    [[], ['market']],
    [['speed_cutoff'], ['speed_cutoff', 'market']],
  ])
  expect(picture && takers(picture)).toEqual([
    { name: 'market', share: 0.5 },
    { name: 'speed_cutoff', share: 0.5 },
  ])
})

it('gives power at the cadence', () => {
  expect(pictureOf('demanded_w', gain, torque, 60)?.z[0]?.[1]).toBeCloseTo(60 * 2 * Math.PI)
})

// Chinese: the words of the surface.
import type { SurfaceKey } from './words.svelte'

export const zh: Record<SurfaceKey, string> = {
  shown: '显示',
  shown_asked_nm: '要求的扭矩',
  shown_given_nm: '到达的扭矩',
  shown_asked_w: '要求的功率',
  shown_given_w: '到达的功率',
  push: '您的踩力',
  mode: '模式',
  slices: '剖面',
  torque_summary: '曲柄处 {least} 至 {most}，60 rpm 下长时间保持。',
  no_mode: '没有模式使用此表，故不产生扭矩。',
  taken: '斜线处被限制：{limits}。',
  taken_by: '{limit}（占图的 {share} %）',
  taken_nothing: '没有限制起作用。',
  slice_speed: '{name}，速度 {speed}',
  slice_rate: '{name}，扭矩变化率 {rate}',
  slice_summary: '{least} 至 {most}。',
  slice_asked: '虚线：要求值，至多 {most}；斜线：被限制。',
  turn: '拖动或用方向键转动',
}

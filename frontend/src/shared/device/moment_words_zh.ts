// Chinese: what a bike did around a fault.
import type { MomentKey } from './moment_words.svelte'

export const zh: Record<MomentKey, string> = {
  title: '当时车的反应',
  rider: '骑行者',
  motor: '电机',
  motor_asked: '电机，请求值',
  fault: '故障',
  no_reading: '没有读数',
  no_frame: '驱动单元没有保存此故障的时刻。',
  not_recorded: '当时没有在记录骑行，那时的实时数据也已不在。',
  in_ride: '查看该次骑行',
  told_rider: '故障前踩踏 {least} 至 {most}。',
  told_unread_before: '故障前没有踩踏读数。',
  told_unread: '自 {at} 秒起没有读数。',
  told_motor: '电机在故障前输出 {before}，最后为 {after}。',
  told_motor_unread: '电机的输出未知。',
}

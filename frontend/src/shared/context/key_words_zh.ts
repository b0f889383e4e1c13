// Chinese: which keys there are.
import type { KeyWord } from './key_words.svelte'

export const zh: Record<KeyWord, string> = {
  go:
    '? 列出这些按键。先按 g，再按 b 车辆、l 实时、t 调校、c 标定、s 维修、r 骑行。',
  bike: 'Enter 打开要做的第一件事。',
  live: 'M 在骑行中标记此刻。空格键暂停曲线；暂停时按 ← → 移动光标，加 Shift 每次 1 秒。',
  rules:
    '方向键移动，Shift 加方向键选择，1 至 5 设为 NB 至 PB，+ − 微调，= 取平，* 缩放，/ 插值，' +
    'S 平滑，Ctrl+C 与 Ctrl+V 复制粘贴，Delete 还原，Ctrl+Z 与 Ctrl+Y 撤销和重做。',
  try: 'O 与 C 显示或隐藏开环和闭环的曲线。在路线曲线上用 ← → 移动光标，加 Shift 移动更多；K 切换公里或时间。',
  why: '← → 移动时刻，加 Shift 移动 1 s；N 与 P 前往下一处和上一处限制。',
  sensor: '空格键采集读数，退格键收回上一个。',
  numbers: '数字',
  numbers_text: '上下方向键微调；按住 Shift 为五倍。',
}

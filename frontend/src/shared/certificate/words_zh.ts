// Chinese: a certificate.
import type { CertificateKey } from './words.svelte'

export const zh: Record<CertificateKey, string> = {
  title: '已证明的内容',
  holds: '就单元所能决定的范围，使用这些设置的任何骑行都不违反其市场的法规：{market}。',
  other_firmware: '对此单元未证明：被证明的是固件 {firmware}，而它运行的是另一版本。',
  broken: '未证明：{what}',
  show: '{count} 条结论及其界限',
  statement: '对任何骑行的任何时刻',
  bound: '已证明',
  allowed: '法规',
  by: '依据',
  never: '从不',
  cutoff: '达到此速度后电机不助力，规则表各点之间也一样',
  band: '所要求的助力在此区间内降为零，宽度',
  walk: '不踩踏时电机推行，仅低于',
  gain: '规则表各点之间的增益，至多',
  ratio: '曲柄处电机转矩与最大踩踏之比，至多',
  market_ratio: '曲柄处电机转矩与当时踩踏之比，至多',
  torque: '曲柄处电机转矩，至多',
  power_peak: '任一时刻给电机的功率指令，至多',
  power_continuous: '任意半小时内功率指令的平均值，至多',
  pedal_stop: '停止踩踏后助力持续，至多',
  push_stop: '最后一次用力后助力持续，至多',
  cut: '到限速、刹车、故障或电池耗尽后归零，不超过',
  lost_reading: '没有新的力矩读数时归零，不超过',
  rise: '曲柄处转矩上升，至多',
  at_most: '≤ {value}',
  at_least: '≥ {value}',
  times: '{value} 倍',
  structure: '控制律的结构',
  interval: '每个单元格的界限',
  recursion: '滤波与斜坡所能记忆的',
  not_covered:
    '不包括：力矩传感器增益与车轮周长是否准确、读数迟到多久、电机是否按指令输出、' +
    '单元断电再上电、其他固件。',
  identity: '证书 {certificate}，规则表 {table}，固件 {firmware}，方法 {method}',
}

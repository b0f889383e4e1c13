// 中文：现状。单元的故障、未保存的数据、修改的结果。
import type { enState } from './en_state'

export const zhState: Record<keyof typeof enState, string> = {
  'faults.one': '1 个故障',
  'faults.many': '{count} 个故障',
  'faults.warning_one': '1 条提示',
  'faults.warning_many': '{count} 条提示',
  'faults.no_assist': '没有助力',
  'faults.title': '单元有什么问题',
  'faults.newer': '{name}（此 Spindle 不认识）',
  'faults.newer_text':
    '单元的固件比此 Spindle 新，没有更多说明。与该固件配套的 Spindle 知道此故障的含义。',
  'faults.old': '这是最后一次见到单元时的情况。',
  'faults.check': '检查什么',
  'faults.announced': '单元故障：{names}。',
  'faults.announced_over': '已消失：{names}。',
  'faults.by_itself': '原因消失一秒后自行结束。',
  'faults.clear_one': '清除故障',
  'faults.clear_many': '清除故障',
  'faults.forget': '清除已消失的故障',
  'faults.clearing': '正在清除…',
  'faults.standing': '车已停稳：原因消失满一秒后即可清除。由单元决定。',
  'faults.moving': '车在移动（{speed}）。单元只在停稳时清除故障：请先停车，电机也要停下。',
  'faults.speed_unknown': '不知车是否停稳。单元只在停稳时清除故障。',
  'faults.cleared': '已清除：{names}。',
  'faults.forgotten': '已消失的故障已清除。',
  'faults.not_cleared_moving': '没有清除，因为车在移动：{names}。请停车后再清除。',
  'faults.not_cleared_cause':
    '没有清除：{names}。车已停稳，说明原因仍在，或消失不到一秒。请排除原因，等一秒后再清除。' +
    '关机再开机也能清除，但只要原因还在，故障会再次出现。',
  'faults.not_asked': '没有清除任何故障：',
  'faults.stop_clear': '让模拟骑手停下并清除',
  'faults.stopping': '模拟骑手正在停下；停稳后清除故障。',

  'live.recorder': '记录：已保存 {saved} 行，丢失 {lost} 行',
  'live.recorder_waiting': '，等待 {waiting} 行',

  'outcome.unchanged': '单元保持原来的内容。',
  'outcome.changed': '应答丢失，但再次询问后确认：修改已在单元中。',
  'outcome.unknown': '不知单元是否已有此修改；单元应答后即会显示。',

  'cannot.read_config': '无法在这里读取此单元的设置。',
  'cannot.write_config': '此单元的设置在这里只能读取，不能修改。',
  'cannot.unit_trial': '此单元不支持试用：写入的内容一直有效。',
  'cannot.stream': '此单元不发送实时数值。',
  'cannot.rider_torque': '此单元不提供骑手扭矩。',
  'cannot.calibrate': '此单元的扭矩传感器不能在这里标定。',
  'cannot.logs': '无法从此单元获取骑行记录。',
  'cannot.fuzzy_table': '此单元的助力不使用规则表。以下是它的设置。',

  'token.title': '需要制造商的令牌',
  'token.factory': '属于出厂设定：需要制造商的令牌。',
  'token.step_ask': '用下方按钮向单元索取质询；此步不写入任何内容。',
  'token.step_hand': '把质询以文字或文件交给制造商。',
  'token.step_paste': '粘贴制造商返回的令牌；随后写入全部修改。',
  'token.without': '没有令牌时：此处保留单元中的值，只写入其余修改。',
  'token.no_key':
    '此单元没有制造商的密钥，无法为它制作令牌，因此任何人都不能修改此值。制造商可为它装入密钥；' +
    '模拟单元可在启动时指定密钥。在此之前请保留单元中的值，只写入其余修改。',
  'token.put_back': '此处保留单元中的值',
  'token.ask': '向单元索取质询',
  'token.change': '修改…',
  'token.change_of': '修改{name}',
}

// 服务器以代码和英文句子说明的内容，按代码译成中文；没有的代码显示服务器的原句。
const lint = {
  assist_above_cutoff: '助力截止速度超过 25 km/h；法规要求此速度以上助力为零',
  no_torque_limit: '电机扭矩上限超过电机所能承受的值',
  gain_rises_with_speed: '车速升高时增益反而上升',
  gain_falls_with_torque_rate: '骑手用力加快时增益反而下降',
  label_step: '相邻两格相差超过一级',
  steep_gain: '增益在 1 km/h 之内变化过大，骑手会感到顿挫',
  gain_at_steady_torque: '匀速蹬踏时已有增益：该模式的助力比永远不会单独生效',
  demand_beyond_motor: '强力骑手的需求超出电机上限：此时由上限决定，模式不起作用',
  centroid_ripple: '各点之间曲面略有起伏，这是最小、最大与重心法的特性；加权平均没有此现象',
  equal_neighbours: '相邻两行或两列完全相同',
  row_not_reached: '该速度行仅在截止速度以上起作用',
  table_not_used: '没有带助力比的模式使用模糊律：规则表不起任何作用',
}

const violation = {
  not_finite: '不是有效数字',
  below_min: '低于允许的最小值',
  above_max: '高于允许的最大值',
  not_increasing: '必须大于前一个值',
  not_a_choice: '不在可选范围内',
  not_text: '不是单元能显示的文字',
  taper_order: '必须大于衰减开始的速度',
  token_needed: '调高此限值需要制造商的令牌',
  access_denied: '只有制造商可以修改',
  not_accepted: '不接受此值',
}

const refusal = {
  unreachable: 'Spindle 服务器没有应答。',
  link: '端口不存在、被占用或已断开。请检查数据线，并确认没有其他程序占用该端口。',
  no_answer: '单元没有应答。请检查电池和数据线，然后重试。',
  not_connected: '单元未连接。',
  peer_protocol: '单元发来的数据不符合协议。',
  read_back_differs: '回读的内容与写入的不同。请重新读取后再试。',
  invalid: '数值无效。',
  out_of_range: '有数值超出允许范围。',
  config_changed: '期间有人修改了单元的配置。请重新读取，核对后再写入。',
  access_denied: '此参数需要更高的权限。',
  token_needed: '此修改需要制造商的令牌。没有写入任何内容。',
  token_refused:
    '单元拒绝此令牌：它属于另一单元、另一次修改、另一质询，或用了另一密钥。请重新写入以获取新的质询。',
  token_expired: '此令牌对应的质询已失效：有效期一分钟，只能尝试一次。请重新写入以获取新的质询。',
  token_delay: '之前有过错误的令牌，单元暂不接受令牌。请稍候再写入。',
  no_token: '这不是令牌。',
  not_standing_still: '车轮或电机在转动。请先停车。',
  conflict: '当前状态不允许此操作。',
  not_found: '没有找到所指的设备、骑行或文件。',
  bad_file: '文件无法读取。',
  store: '数据存储失败，没有保存。',
  no_trial: '单元中没有正在试用的修改：已保留、已恢复或时间已到。请重新读取配置。',
  unknown_trial: '试用的修改并非由此 Spindle 写入，不知其本意。请恢复，或用写入它的工具保留。',
  read_only: '此单元只能读取，不能修改。',
  too_large: '文件过大。',
  unsupported_format: '不支持此文件格式。',
  busy: '单元正忙于另一项修改，请稍后再试。',
  state: '单元当前状态不允许此操作，请重新开始。',
  range: '有数值超出单元允许的范围。',
  access: '此操作需要更高的权限。',
  stale_base: '期间配置已被修改，请重新读取。',
  invalid_config: '各数值相互矛盾。',
  not_stopped: '车轮或电机在转动。请先停车。',
  flash_fail: '单元的存储器写入失败。',
  verify_fail: '单元的存储器未能保持写入的内容。',
  no_space: '单元没有剩余空间。',
  bandwidth: '线路速率不足。',
  expired: '已超时，请重新开始。',
  rate_limit: '刚刚写过存储器，请两秒后再试。',
  unsupported: '单元固件尚不支持此操作。',
  session: '单元期间重启过。',
  undervoltage: '单元电池电压过低。',
  internal: '单元内部出错。',
}

// What a fault means: the server's sentence is for the mechanic.
const fault = {
  TORQUE_SENSOR: '扭矩传感器读数到达端点或缺失，没有助力。请检查传感器线缆，再检查零点。',
  SPEED_SENSOR: '速度不合理或缺失，没有助力。请检查磁铁和线缆。',
  BATTERY_LOW: '电池电压低于助力截止电压。请充电。',
  CONFIG_DEFAULTED: '单元没有找到完好的配置，正以出厂值运行。请恢复备份。',
}

export const zhCodes = { lint, violation, refusal, fault }
export type Saying = keyof typeof zhCodes

import type { RideFileKey } from './file_words.svelte'

export const zh: Record<RideFileKey, string> = {
  file: '文件中的内容',
  whole: '文件中的每条记录和每个数值都在这次骑行中。',
  kept: '{read} 条记录中有 {kept} 条是这次骑行的数据行。',
  sport: '运动类型：{sport}',
  joined: '{count} 条与同一时刻的另一条互补，已合并',
  spread: '{count} 条与其他记录时刻相同：在该时刻内均匀排列',
  moved: '时钟倒退 {count} 次；数据行已按时间排序',
  no_time: '{count} 条没有时间',
  clock_not_set: '{count} 条在时钟校准之前',
  clock_jumped: '{count} 条的时钟跳走',
  no_value: '{count} 条没有任何数值',
  values: '{channel} 有 {count} 个不可能的数值已略去',
  taken_unit: '{column} 的单位为 {value}（由车主说明）',
  taken_time_zone: '时间属于 {value}（由车主说明）',
  taken_clock: '时间属于 {value}：与文件中 UTC 开始时间的差',
  taken_rows_per_second: '每秒 {value} 行',
  taken_file_name: '日期和时间取自文件名',
  taken_none: '文件没有日期：骑行按上传时间排列',
  unread: '{field} 不是单个数值（{count} 条记录）',
}

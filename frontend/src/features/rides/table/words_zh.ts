import type { TableKey } from './words.svelte'

export const zh: Record<TableKey, string> = {
  title: '{name} 没有说明的内容',
  why: '不作任何猜测。您在此的回答会用于列名相同的所有文件。',
  zone: '其时间的时区',
  zone_hint: '地点，例如 Europe/Dublin，或 UTC。',
  rate: '每秒行数',
  rate_hint: '各行没有时间。记录器通常每秒写 1、5 或 10 行。',
  column: '列',
  becomes: '含义',
  unit: '单位',
  first: '前几行',
  nothing: '以原名保留',
  when: '时间',
  choose: '请选择…',
  unit_of: '{column} 的单位',
  read: '读取文件',
  cancel: '以后再说',
  reading: '正在读取…',
}

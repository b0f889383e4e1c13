// Chinese: where everything is kept.
import type { SettingsKey } from './words.svelte'

export const zh: Record<SettingsKey, string> = {
  rider: '骑手',
  threshold: '阈值功率 (W)',
  heart_rate: '最大心率 (bpm)',
  rider_note: '您能维持一小时的功率，以及极限时的心率。骑行分区以此为准。保存在此浏览器中；不知道可留空。',
  data: '数据与备份',
  folder: '骑行与文件',
  database: '数据库',
  holds: '已保存',
  holds_all: '{rides} 次骑行 · {size}',
  free: '该磁盘剩余空间',
  unknown: '— 服务器没有应答',
  backup: '保存备份',
  backup_note:
    '一个 zip 文件，包含此刻的全部内容：骑行、原始文件、驱动单元、设置历史与库。' +
    '数据库在发送前经过检查；中断的 zip 无法打开。',
  backup_server:
    '数据库在另一台服务器上，不在 zip 中：请另用 pg_dump 保存。仅凭 zip 也能恢复每次骑行。',
  restore: '如何恢复',
  restore_stop: '停止此 Spindle。',
  restore_unpack: '将 zip 解压到空文件夹。',
  restore_check: '确认内容完整：',
  restore_start: '从该文件夹启动：',
  restore_rebuild: '若只有数据库损坏，可由骑行自身的文件重建：',
  place: '文件夹',
  tables: '您回答过的表格',
  tables_note:
    '您对未说明单位或时区的表格所作的回答，按列名保存。忘记后，下一个同类文件会再次询问；已读取的骑行不变。',
  rows_a_second: '每秒 {count} 行',
  forget: '忘记',
  forget_named: '忘记对 {columns} 的回答',
}

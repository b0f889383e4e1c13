import type { IntakeKey } from './intake_words.svelte'

export const zh: Record<IntakeKey, string> = {
  going: '正在导入 {count} 个文件',
  over: '{count} 个文件已处理',
  done: '已完成 {done} / {count}',
  seconds: '约剩 {count} 秒',
  minutes: '约剩 {count} 分钟',
  pause: '暂停',
  resume: '继续',
  stop: '停止',
  waiting: '等待处理。',
  stopped: '未发送。再次选择此文件，即从中断处继续。',
  away: '已暂停：服务器没有应答。没有丢失任何内容；恢复后可继续。',
  count_complete: '{count} 个完整读取',
  count_here: '{count} 个已存在，未重复保存',
  count_partial: '{count} 个有损坏，部分读取',
  count_rejected: '{count} 个未读取：原因与办法',
  count_waiting: '{count} 个等待处理',
  count_sending: '{count} 个正在传送',
  count_stopped: '{count} 个未发送',
  more: '另有 {count} 个',
  folder: '选择文件夹…',
}

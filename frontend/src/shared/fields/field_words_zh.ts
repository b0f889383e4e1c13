import type { FieldKey } from './field_words.svelte'

export const zh: Record<FieldKey, string> = {
  number: '这不是一个数字。',
  integer: '这不是一个整数。',
  integer_within: '请输入 {min} 到 {max} 之间的整数。',
  numbers: '其中有的不是数字。数字之间请用空格或“；”隔开。',
  within: '请输入 {min} 到 {max} 之间的数字。',
  at_least: '请输入不小于 {min} 的数字。',
}

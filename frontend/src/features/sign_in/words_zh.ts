// Chinese: signing in and the person's menu.
import type { SignInKey } from './words.svelte'

export const zh: Record<SignInKey, string> = {
  title: '登录',
  name: '姓名',
  password: '密码',
  sign_in: '登录',
  signing_in: '正在登录…',
  lost: '忘记密码？管理员可在设置中为您重设，或使用命令',
  first_title: '第一位管理员',
  first_note:
    '此链接只能使用一次。请选择您的姓名（会显示在您的修改旁）和至少 8 个字符的密码；一句话就很好。',
  first: '开始',
  needs_first: '还没有管理员。服务器启动时打印了一个链接：请打开它。',
  wait: '错误的密码太多。请等待 {seconds} 秒后再试。',
  nothing_yours: '您已登录为 {name}。',
  nothing_yours_note: '这里还没有属于您的内容：骑手只能看到自己的车和骑行，而目前没有登记给您的。请询问您的经销商。',
  sign_out: '退出登录',
  person: '{initials}，已登录：{name}',
  settings: '密码与账户',
  role_rider: '骑手',
  role_dealer: '经销商',
  role_engineer: '工程师',
  role_admin: '管理员',
}

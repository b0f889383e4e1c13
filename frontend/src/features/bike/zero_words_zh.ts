export const zh = {
  ok: '滑行时的零点，{when}',
  watch: '零点已移动：请留意',
  act: '零点已移动：请标定',
}

// Chinese: the rides since a change.
import type { SinceKey } from './since_words.svelte'

export const zh: Record<SinceKey, string> = {
  since: '此后的骑行',
  title: '此更改之后',
  before: '之前',
  after: '之后',
  rides: '骑行次数',
  distance_km: '距离',
  speed_kmh_mean: '行驶中的平均速度',
  motor_wh_per_km: '每单位距离的电机做功',
  spread: '单次骑行的最小至最大',
  rider_wh_per_km: '每单位距离的您的做功',
  battery_wh_per_km: '每单位距离的电池输出',
  assist_ratio: '电机做功与您的做功之比',
  more: '之后的每次骑行，单位距离的电机做功都多于之前的每次骑行。',
  less: '之后的每次骑行，单位距离的电机做功都少于之前的每次骑行。',
  mixed: '之后与之前的骑行相互重叠：看不出此更改有任何作用。',
  too_few: '骑行太少，无法判断：前后至少各需三次测得电机做功的骑行。',
  cannot: '路线、风与日子都不同：变化可能由此而来。',
  during: '在骑行途中更改、两边都不计入的骑行：{count} 次。',
  others: '这些骑行期间还有其他更改：{count} 次。',
}

/* The fuzzy gain in closed form: no grid, no loop over a universe, at most four rules.
 *
 * Neighbouring triangles sum to one, so an input lies in two sets at most and four rules fire at
 * most. Clipped triangles (min) joined by max are then polygons whose area and moment are known:
 * over one gap between two output peaks, clipped at L on the left and R on the right, with the gap
 * as unit length, S = L + R and D = |L - R|,
 *     area = (S + D (1 - S)) / 2
 *     moment about the gap's middle = q(R) - q(L),  q(s) = s^2 / 4 - s^3 / 6.
 * Both need min(L, R) <= 1/2, which holds because only one of four rules can fire above 1/2. */
#include "fuzzy_table.h"

#include "float32.h" // float32_clamp, float32_is_finite, float32_missing

static const float GAIN_MIN = 0.0f; /* the thesis' universe of the gain; protects the rider */
static const float GAIN_MAX = 0.5f;

static const float STEP_SHARE =
    0.99f; /* of the least distance: room for the rounding of decimals */

#define BLOCK 64 /* points a batch works on at once: their levels stay in the first cache */

typedef struct {
    unsigned lower; /* index of the set below; the set above is the next */
    float share;    /* membership of the set above; the set below has the rest */
} membership;

/* Clamping to the first point is what makes the first set a left shoulder. The comparisons are so
 * written that a NaN ends inside the table too: the batch blanks its gain afterwards. */
static inline membership locate(const float *points, float value)
{
    membership found;
    float clamped = float32_clamp(value, points[0], points[FUZZY_SETS - 1]);

    found.lower = (unsigned)(clamped >= points[1]) + (unsigned)(clamped >= points[2]) +
                  (unsigned)(clamped >= points[3]);
    found.share = (clamped - points[found.lower]) / (points[found.lower + 1] - points[found.lower]);
    return found;
}

/* What the output peaks alone decide; made once for a batch. */
typedef struct {
    float width[FUZZY_SETS - 1]; /* of the gap above each peak but the last */
    float middle[FUZZY_SETS - 1];
    float first_reach; /* how much of the outermost halves lies inside the universe, */
    float last_reach;  /* 0 to 1 of the width of their inner halves */
    float first_peak;
    float last_peak;
} gain_gaps;

static gain_gaps gaps_of(const float *peaks)
{
    gain_gaps gaps;
    unsigned gap;

    for (gap = 0; gap + 1 < FUZZY_SETS; ++gap) {
        gaps.width[gap] = peaks[gap + 1] - peaks[gap];
        gaps.middle[gap] = 0.5f * (peaks[gap] + peaks[gap + 1]);
    }
    gaps.first_reach = float32_min((peaks[0] - GAIN_MIN) / gaps.width[0], 1.0f);
    gaps.last_reach =
        float32_min((GAIN_MAX - peaks[FUZZY_SETS - 1]) / gaps.width[FUZZY_SETS - 2], 1.0f);
    gaps.first_peak = peaks[0];
    gaps.last_peak = peaks[FUZZY_SETS - 1];
    return gaps;
}

/* What one output set adds beyond its peak, per unit of width: a triangle cut where the universe
 * ends, clipped at `level`. The moment is about the peak. */
static inline float outer_area(float level, float reach)
{
    float flat = float32_min(reach, 1.0f - level);
    float end_level = float32_min(level, 1.0f - reach);

    return level * flat + 0.5f * (reach - flat) * (level + end_level);
}

static inline float outer_moment(float level, float reach)
{
    float flat = float32_min(reach, 1.0f - level);
    float slope = reach - flat;
    float end_level = float32_min(level, 1.0f - reach);

    return flat * (0.5f * level * flat + 0.5f * slope * (level + end_level)) +
           slope * slope * (level + 2.0f * end_level) * (1.0f / 6.0f);
}

static inline float gap_area(float left, float right)
{
    float sum = left + right;

    return 0.5f * (sum + float32_abs(left - right) * (1.0f - sum));
}

static inline float clip_moment(float level)
{
    return level * level * (0.25f - level * (1.0f / 6.0f));
}

/* Centroid of the five clipped sets. One level is at least 1/2, so the area is never zero. Without
 * a branch, so that the batch runs it on several points at once. */
static inline float centroid(const gain_gaps *gaps, float nb, float ns, float zo, float ps,
                             float pb)
{
    const float *width = gaps->width;
    const float *middle = gaps->middle;
    float first = width[0] * outer_area(nb, gaps->first_reach);
    float last = width[3] * outer_area(pb, gaps->last_reach);
    float area_0 = width[0] * gap_area(nb, ns);
    float area_1 = width[1] * gap_area(ns, zo);
    float area_2 = width[2] * gap_area(zo, ps);
    float area_3 = width[3] * gap_area(ps, pb);
    float clip_0 = clip_moment(nb);
    float clip_1 = clip_moment(ns);
    float clip_2 = clip_moment(zo);
    float clip_3 = clip_moment(ps);
    float clip_4 = clip_moment(pb);
    float area = (first + area_0) + (area_1 + area_2) + (area_3 + last);
    float moment = gaps->first_peak * first + middle[0] * area_0 + middle[1] * area_1 +
                   middle[2] * area_2 + middle[3] * area_3 + gaps->last_peak * last;

    moment += width[0] * width[0] * (clip_1 - clip_0 - outer_moment(nb, gaps->first_reach));
    moment += width[1] * width[1] * (clip_2 - clip_1);
    moment += width[2] * width[2] * (clip_3 - clip_2);
    moment += width[3] * width[3] * (clip_4 - clip_3 + outer_moment(pb, gaps->last_reach));
    return moment / area;
}

/* Levels of the five output sets: min of the two memberships, max where rules share a set. A level
 * lies `stride` floats after the one before, all of them zero on entry. */
static inline void fire_rules(const fuzzy_table *table, membership speed, membership rate,
                              float *levels, size_t stride)
{
    const uint8_t *slow = table->rules[speed.lower];
    const uint8_t *fast = table->rules[speed.lower + 1];
    float speed_rest = 1.0f - speed.share;
    float rate_rest = 1.0f - rate.share;
    float *level;

    levels[slow[rate.lower] * stride] = float32_min(speed_rest, rate_rest);
    level = &levels[slow[rate.lower + 1] * stride];
    *level = float32_max(*level, float32_min(speed_rest, rate.share));
    level = &levels[fast[rate.lower] * stride];
    *level = float32_max(*level, float32_min(speed.share, rate_rest));
    level = &levels[fast[rate.lower + 1] * stride];
    *level = float32_max(*level, float32_min(speed.share, rate.share));
}

/* Product and weighted mean of the peaks: bilinear between the table's cells. */
static inline float weighted_gain(const fuzzy_table *table, membership speed, membership rate)
{
    const uint8_t *slow = table->rules[speed.lower];
    const uint8_t *fast = table->rules[speed.lower + 1];
    const float *peaks = table->gain_points;
    float below = 1.0f - rate.share;
    float slow_gain = below * peaks[slow[rate.lower]] + rate.share * peaks[slow[rate.lower + 1]];
    float fast_gain = below * peaks[fast[rate.lower]] + rate.share * peaks[fast[rate.lower + 1]];

    return (1.0f - speed.share) * slow_gain + speed.share * fast_gain;
}

/* One block through both stages: rules point by point, then centroids several at once. */
static void centroid_block(const fuzzy_table *table, const gain_gaps *gaps, const float *speeds_kmh,
                           const float *torque_rates, float *gains, size_t count)
{
    float levels[FUZZY_SETS * BLOCK] = {0.0f};
    float centroids[BLOCK];
    size_t index;

    for (index = 0; index < count; ++index) {
        fire_rules(table, locate(table->speed_points_kmh, speeds_kmh[index]),
                   locate(table->torque_rate_points, torque_rates[index]), levels + index, BLOCK);
    }
    for (index = 0; index < BLOCK; ++index) {
        centroids[index] =
            centroid(gaps, levels[index], levels[BLOCK + index], levels[2 * BLOCK + index],
                     levels[3 * BLOCK + index], levels[4 * BLOCK + index]);
    }
    for (index = 0; index < count; ++index) gains[index] = centroids[index];
}

static void weighted_block(const fuzzy_table *table, const float *speeds_kmh,
                           const float *torque_rates, float *gains, size_t count)
{
    size_t index;

    for (index = 0; index < count; ++index) {
        gains[index] = weighted_gain(table, locate(table->speed_points_kmh, speeds_kmh[index]),
                                     locate(table->torque_rate_points, torque_rates[index]));
    }
}

static size_t blank_refused(const float *speeds_kmh, const float *torque_rates, float *gains,
                            size_t count)
{
    size_t refused = 0;
    size_t index;

    for (index = 0; index < count; ++index) {
        if (!float32_is_finite(speeds_kmh[index]) || !float32_is_finite(torque_rates[index])) {
            gains[index] = float32_missing();
            refused += 1;
        }
    }
    return refused;
}

/* As the protocol's check has it (ebl_values.c): the two must agree to the bit. */
static int points_check(const float *points, float least_step)
{
    unsigned index;

    for (index = 0; index < FUZZY_SETS; ++index) {
        if (!float32_is_finite(points[index])) return FUZZY_TABLE_REFUSED;
        if (index > 0 && !(points[index] - points[index - 1] >= STEP_SHARE * least_step)) {
            return FUZZY_TABLE_REFUSED;
        }
    }
    return FUZZY_OK;
}

int fuzzy_table_check(const fuzzy_table *table)
{
    unsigned row;
    unsigned column;

    if (points_check(table->speed_points_kmh, FUZZY_SPEED_STEP_KMH)) return FUZZY_TABLE_REFUSED;
    if (points_check(table->torque_rate_points, FUZZY_TORQUE_RATE_STEP)) return FUZZY_TABLE_REFUSED;
    if (points_check(table->gain_points, FUZZY_GAIN_STEP)) return FUZZY_TABLE_REFUSED;
    if (table->gain_points[0] < GAIN_MIN) return FUZZY_TABLE_REFUSED;
    if (table->gain_points[FUZZY_SETS - 1] > GAIN_MAX) return FUZZY_TABLE_REFUSED;
    if (table->inference > FUZZY_WEIGHTED_AVERAGE) return FUZZY_TABLE_REFUSED;
    for (row = 0; row < FUZZY_SETS; ++row) {
        for (column = 0; column < FUZZY_SETS; ++column) {
            if (table->rules[row][column] >= FUZZY_SETS) return FUZZY_TABLE_REFUSED;
        }
    }
    return FUZZY_OK;
}

int fuzzy_gain(const fuzzy_table *table, float speed_kmh, float torque_rate, float *gain)
{
    float levels[FUZZY_SETS] = {0.0f};
    membership speed;
    membership rate;
    gain_gaps gaps;

    *gain = 0.0f;
    if (!float32_is_finite(speed_kmh) || !float32_is_finite(torque_rate)) {
        return FUZZY_INPUT_REFUSED;
    }
    speed = locate(table->speed_points_kmh, speed_kmh);
    rate = locate(table->torque_rate_points, torque_rate);
    if (table->inference == FUZZY_WEIGHTED_AVERAGE) {
        *gain = weighted_gain(table, speed, rate);
        return FUZZY_OK;
    }
    gaps = gaps_of(table->gain_points);
    fire_rules(table, speed, rate, levels, 1);
    *gain = centroid(&gaps, levels[0], levels[1], levels[2], levels[3], levels[4]);
    return FUZZY_OK;
}

size_t fuzzy_rules_fired(const fuzzy_table *table, float speed_kmh, float torque_rate,
                         fuzzy_rule fired[FUZZY_RULES_FIRED_MAX])
{
    membership speed;
    membership rate;
    size_t count = 0;
    unsigned corner;

    if (!float32_is_finite(speed_kmh) || !float32_is_finite(torque_rate)) return 0;
    speed = locate(table->speed_points_kmh, speed_kmh);
    rate = locate(table->torque_rate_points, torque_rate);
    for (corner = 0; corner < FUZZY_RULES_FIRED_MAX; ++corner) {
        unsigned row = speed.lower + corner / 2u;
        unsigned column = rate.lower + corner % 2u;
        float by_speed = corner / 2u ? speed.share : 1.0f - speed.share;
        float by_rate = corner % 2u ? rate.share : 1.0f - rate.share;
        float weight = table->inference == FUZZY_WEIGHTED_AVERAGE ? by_speed * by_rate
                                                                  : float32_min(by_speed, by_rate);
        fuzzy_rule rule = {(uint8_t)row, (uint8_t)column, table->rules[row][column], weight};

        if (weight > 0.0f) fired[count++] = rule;
    }
    return count;
}

size_t fuzzy_gain_run(const fuzzy_table *table, const float *speeds_kmh, const float *torque_rates,
                      float *gains, size_t count)
{
    gain_gaps gaps = gaps_of(table->gain_points);
    size_t refused = 0;
    size_t start;

    for (start = 0; start < count; start += BLOCK) {
        size_t length = count - start < BLOCK ? count - start : BLOCK;

        if (table->inference == FUZZY_WEIGHTED_AVERAGE) {
            weighted_block(table, speeds_kmh + start, torque_rates + start, gains + start, length);
        } else {
            centroid_block(table, &gaps, speeds_kmh + start, torque_rates + start, gains + start,
                           length);
        }
        refused += blank_refused(speeds_kmh + start, torque_rates + start, gains + start, length);
    }
    return refused;
}

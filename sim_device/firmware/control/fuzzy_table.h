/* The fuzzy gain: two inputs, five sets each, 25 rules, one gain (thesis 4.6, table 4-2). */
#ifndef SPINDLE_FUZZY_TABLE_H
#define SPINDLE_FUZZY_TABLE_H

#include <stddef.h>
#include <stdint.h>

#define FUZZY_SETS 5

/* Least distances of neighbouring points, as `least_step` in the registry. Nearer than that a set
 * is narrower than what its input can tell apart: a speed is a tenth of a km/h late within one turn
 * of the wheel, the sensor's noise alone moves the rate by a thousandth, and nobody feels a
 * thousandth of gain. No gap is then so small that its square is lost in a float. A hundredth less
 * is accepted, so that decimals that are so far apart still are as float32. */
#define FUZZY_SPEED_STEP_KMH 0.1f
#define FUZZY_TORQUE_RATE_STEP 0.001f
#define FUZZY_GAIN_STEP 0.001f

typedef enum { FUZZY_MAMDANI_CENTROID = 0, FUZZY_WEIGHTED_AVERAGE = 1 } fuzzy_inference;

typedef struct {
    float speed_points_kmh[FUZZY_SETS]; /* peaks, increasing; a left shoulder at the first */
    float torque_rate_points[FUZZY_SETS];
    float gain_points[FUZZY_SETS];
    uint8_t rules[FUZZY_SETS][FUZZY_SETS]; /* [speed][torque rate], label 0 NB to 4 PB */
    uint8_t inference;                     /* fuzzy_inference */
} fuzzy_table;

#define FUZZY_RULES_FIRED_MAX 4

/* A rule that has a say, and how much: the lesser of its two memberships under the centroid, their
 * product under the weighted average. */
typedef struct {
    uint8_t row; /* speed */
    uint8_t column;
    uint8_t label;
    float weight; /* above 0, to 1 */
} fuzzy_rule;

enum { FUZZY_OK = 0, FUZZY_INPUT_REFUSED = -1, FUZZY_TABLE_REFUSED = -2 };

/* FUZZY_OK, or FUZZY_TABLE_REFUSED if points are not finite, not increasing or nearer than their
 * least distance, a gain is outside [0, 0.5] or a label or the inference is unknown. */
int fuzzy_table_check(const fuzzy_table *table);

/* Gain at one point, inputs clamped to the table. A non-finite input is refused and gain set to 0.
 * Centroid of triangles clipped by min and joined by max over [0, 0.5], exact; or the weighted mean
 * of the peaks. The table must have passed fuzzy_table_check. */
int fuzzy_gain(const fuzzy_table *table, float speed_kmh, float torque_rate, float *gain);

/* The rules behind fuzzy_gain at one point, by row and column. Returns how many; none for a
 * non-finite input. */
size_t fuzzy_rules_fired(const fuzzy_table *table, float speed_kmh, float torque_rate,
                         fuzzy_rule fired[FUZZY_RULES_FIRED_MAX]);

/* `count` points; a refused point gives NaN. Returns how many were refused. */
size_t fuzzy_gain_run(const fuzzy_table *table, const float *speeds_kmh, const float *torque_rates,
                      float *gains, size_t count);

#endif

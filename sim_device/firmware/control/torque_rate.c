/* The relative change of torque over the rate interval (thesis eq. 4.16, thesis_checks I-15). */
#include "assist_steps.h" // torque_history_swap, torque_rate_of
#include "float32.h"      // float32_clamp, float32_is_finite

#define RING_MASK (ASSIST_RATE_HISTORY - 1u) /* the length is a power of two */

float torque_history_swap(const assist_config *config, assist_state *state)
{
    unsigned steps = (unsigned)(config->torque_rate_interval_s / config->step_s + 0.5f);
    unsigned now = state->history_next & RING_MASK;
    float earlier_nm = state->torque_history_nm[(now - steps) & RING_MASK];

    state->torque_history_nm[now] = state->torque_filtered_nm;
    state->history_next = (uint16_t)((now + 1u) & RING_MASK);
    return earlier_nm;
}

/* What counts as a rise below the floor. The sensor's noise (0.06 Nm) leaves 0.006 Nm after the
 * average; without this a bike at rest would show the gain of a start now and then. */
static const float START_RISE_NM = 0.05f;

/* Below the floor a relative change means nothing: a rise counts as the fastest the table knows,
 * because it is a start. */
float torque_rate_of(const assist_config *config, float torque_nm, float earlier_torque_nm)
{
    float first = config->table.torque_rate_points[0];
    float last = config->table.torque_rate_points[FUZZY_SETS - 1];
    float rise_nm = torque_nm - earlier_torque_nm;

    if (!(rise_nm > 0.0f && float32_is_finite(rise_nm))) return first;
    if (earlier_torque_nm < config->torque_rate_floor_nm) {
        return rise_nm < START_RISE_NM ? first : last;
    }
    return float32_clamp(rise_nm / earlier_torque_nm, first, last);
}

/* Averages the rider's torque over the stroke.
 *
 * Legs push twice a turn, with dead spots between. A law on the raw torque would follow them into
 * the motor's and the battery's limits and lose the peaks (thesis_checks 4.4: the slope ends at
 * 18.4 instead of 22.1 km/h). docs/torque-filter.md compares the two filters. */
#include "assist_steps.h" // stroke_average_nm

/* The low-pass is a backward Euler: stable for any time constant, and the identity for zero. */
float stroke_average_nm(const assist_config *config, const assist_state *state, float torque_nm)
{
    float share = config->step_s / (config->torque_filter_s + config->step_s);

    if (config->torque_filter == ASSIST_FILTER_HALF_TURN) return state->turn.mean_nm;
    return state->torque_filtered_nm + share * (torque_nm - state->torque_filtered_nm);
}

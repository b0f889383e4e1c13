/* Averages the rider's torque over the stroke.
 *
 * Legs push twice a turn, with dead spots between. A law on the raw torque would follow them into
 * the motor's and the battery's limits and lose the peaks (thesis_checks 4.4: the slope ends at
 * 18.4 instead of 22.1 km/h). */
#include "assist_steps.h" // stroke_average_nm

/* Backward Euler: stable for any time constant, and the identity for zero. */
float stroke_average_nm(const assist_config *config, float averaged_nm, float torque_nm)
{
    float share = config->step_s / (config->torque_filter_s + config->step_s);

    return averaged_nm + share * (torque_nm - averaged_nm);
}

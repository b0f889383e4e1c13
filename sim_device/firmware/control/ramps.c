/* How fast the assist may change: gently up for balance, gently down for comfort. */
#include "assist_steps.h" // apply_ramps

float apply_ramps(const assist_config *config, float previous_nm, float wanted_nm,
                  assist_output *output)
{
    float highest_nm = previous_nm + config->assist_ramp_up_nm_per_s * config->step_s;
    float lowest_nm = previous_nm - config->assist_ramp_down_nm_per_s * config->step_s;

    if (wanted_nm > highest_nm) {
        output->limit_flags |= ASSIST_LIMIT_RAMP_UP;
        return highest_nm;
    }
    if (wanted_nm < lowest_nm) {
        output->limit_flags |= ASSIST_LIMIT_RAMP_DOWN;
        return lowest_nm;
    }
    return wanted_nm;
}

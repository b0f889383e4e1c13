/* How fast the assist may change: gently up for balance, gently down for comfort. */
#include "assist_steps.h" // apply_ramps, torque_is_fresh
#include "float32.h"      // float32_max, float32_min

/* The rotor sends a word every 2 ms; a burst once a turn may take a few. What is older than this
 * says nothing of the rider (thesis_checks 6: hold 50 ms, then ramp to zero). */
#define TORQUE_HOLD_MS 50u

/* From the motor's full torque to nothing in 0.2 s, whatever gentle ramp a mode has. */
static const float LOST_RAMP_NM_PER_S = 400.0f;

int torque_is_fresh(const assist_input *input) { return input->torque_age_ms <= TORQUE_HOLD_MS; }

float apply_ramps(const assist_config *config, const assist_input *input, float previous_nm,
                  float wanted_nm, assist_output *output)
{
    float up_nm_per_s =
        float32_min(config->assist_ramp_up_nm_per_s, config->mode_ramp_up_nm_per_s[input->mode]);
    float down_nm_per_s = float32_min(config->assist_ramp_down_nm_per_s,
                                      config->mode_ramp_down_nm_per_s[input->mode]);
    float highest_nm = previous_nm + up_nm_per_s * config->step_s;
    float lowest_nm;

    if (!torque_is_fresh(input)) down_nm_per_s = float32_max(down_nm_per_s, LOST_RAMP_NM_PER_S);
    lowest_nm = previous_nm - down_nm_per_s * config->step_s;
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

#include "hold.h"

#include "assist.h" // assist_step

/* Rounding of a steady torque must not count as a falling one. */
static const float STEADY_SHARE = 1.0f - 5.0e-7f;

/* How far the minute of a continuous rating goes on in a step: its limit answers eleven times as
 * fast as the mean, so 3 s of 60 s leave half of what is missing in each step and do not swing. */
static const float HURRY_S = 3.0f;

static void rise_at(assist_state *state, float torque_rate)
{
    float earlier_nm = state->torque_filtered_nm / (1.0f + torque_rate) * STEADY_SHARE;
    unsigned i;

    for (i = 0; i < ASSIST_RATE_HISTORY; ++i) state->torque_history_nm[i] = earlier_nm;
}

void assist_hold(const assist_config *config, assist_state *state, const assist_input *input,
                 float torque_rate, uint32_t steps, assist_output *output)
{
    for (; steps > 0; --steps) {
        (void)assist_step(config, state, input, output); /* what is refused is in its flags */
        rise_at(state, torque_rate);
    }
}

void assist_settle(const assist_config *config, assist_state *state, const assist_input *inputs,
                   const float *torque_rates, uint32_t steps, assist_output *outputs, size_t count)
{
    float hurry = HURRY_S / config->step_s;
    size_t i;

    for (i = 0; i < count; ++i) {
        uint32_t left;

        for (left = steps; left > 0; --left) {
            float mean_w = state->motor_power_mean_w;

            rise_at(state, torque_rates[i]);
            (void)assist_step(config, state, &inputs[i], &outputs[i]);
            state->motor_power_mean_w = mean_w + hurry * (state->motor_power_mean_w - mean_w);
        }
    }
}

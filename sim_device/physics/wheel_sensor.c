#include "wheel_sensor.h"

#include "noise.h"

void wheel_sensor_reset(wheel_sensor_state *state, uint64_t seed)
{
    const wheel_sensor_state fresh = {.next = 0.5, .number = 0.5, .noise = seed};
    *state = fresh;
}

void wheel_sensor_step(const wheel_sensor_config *config, wheel_sensor_state *state, double turns,
                       double missed_share, double dt_s)
{
    const double before = state->turned;
    const double moved = turns * config->pulses_per_turn;
    state->turned += moved;
    state->pulse_age_s += dt_s;
    while (moved > 0.0 && state->next <= state->turned) {
        if (!(missed_share > 0.0) || noise_uniform(&state->noise) >= missed_share) {
            const double share = (state->next - before) / moved;
            state->pulses++;
            state->pulse_age_s = dt_s * (1.0 - (share > 0.0 ? share : 0.0));
        }
        state->number += 1.0;
        state->next = state->number;
        if (config->jitter_share > 0.0) {
            state->next += config->jitter_share * noise_gaussian(&state->noise);
        }
    }
}

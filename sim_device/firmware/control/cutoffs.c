/* What takes the assist away at once: no pedalling, brake, speed, an empty battery.
 *
 * They protect the rider and the public (EN 15194: assist ends when pedalling or braking says so
 * and at the cut-off speed), so they come after the ramps and never wait for them. */
#include "assist_steps.h" // apply_cutoff_band, apply_cutoffs, held_at
#include "float32.h"      // float32_max, float32_min
#include "market.h"       // market_cutoff_kmh, market_profile_of

/* Forward pedalling renews the permission, back-pedalling ends it, standing cranks use it up. */
static int pedalling(const assist_config *config, assist_state *state, float cadence_rpm)
{
    float stop_s =
        float32_min(config->pedal_stop_s, market_profile_of(config->market)->pedal_stop_s);

    if (cadence_rpm > 0.0f) {
        state->pedal_steps_left = (uint16_t)(stop_s / config->step_s + 0.5f);
        return 1;
    }
    if (cadence_rpm < 0.0f || state->pedal_steps_left == 0) {
        state->pedal_steps_left = 0;
        return 0;
    }
    state->pedal_steps_left = (uint16_t)(state->pedal_steps_left - 1u);
    return state->pedal_steps_left > 0;
}

float apply_cutoff_band(const assist_config *config, const assist_input *input, float demand_nm,
                        assist_output *output)
{
    float below_kmh = float32_max(market_cutoff_kmh(config) - input->speed_kmh, 0.0f);

    if (below_kmh >= config->assist_cutoff_band_kmh) return demand_nm;
    return held_at(demand_nm * (below_kmh / config->assist_cutoff_band_kmh), demand_nm,
                   ASSIST_LIMIT_SPEED_CUTOFF, output);
}

float apply_cutoffs(const assist_config *config, assist_state *state, const assist_input *input,
                    float demand_nm, assist_output *output)
{
    float left_nm = demand_nm;

    if (!walk_is_on(state) && !pedalling(config, state, input->cadence_rpm)) {
        left_nm = held_at(0.0f, demand_nm, ASSIST_LIMIT_PEDAL_STOP, output);
    }
    if (input->brake) left_nm = held_at(0.0f, demand_nm, ASSIST_LIMIT_BRAKE, output);
    if (input->speed_kmh >= market_cutoff_kmh(config)) {
        left_nm = held_at(0.0f, demand_nm, ASSIST_LIMIT_SPEED_CUTOFF, output);
    }
    if (input->battery_voltage_v < config->battery_voltage_v_min) {
        left_nm = held_at(0.0f, demand_nm, ASSIST_LIMIT_BATTERY_VOLTAGE, output);
    }
    if (input->inhibit) left_nm = held_at(0.0f, demand_nm, ASSIST_LIMIT_FAULT, output);
    return left_nm;
}

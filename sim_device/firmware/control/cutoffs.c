/* What takes the assist away at once: no pedalling, brake, speed, an empty battery.
 *
 * They protect the rider and the public (EN 15194: assist ends when pedalling or braking says so
 * and at the cut-off speed), so they come after the ramps and never wait for them. */
#include "assist_steps.h" // apply_cutoff_band, apply_cutoffs, held_at
#include "float32.h"      // float32_max, float32_min
#include "market.h"       // market_cutoff_band_kmh, market_cutoff_kmh, market_profile_of

static const float PUSH_HALF_SECOND_S = 0.5f;

/* Legs that turn the cranks and push less than this for a second and a half do not ride: 6 W at 60
 * rpm. Who pushes with one leg alone does so every second at 30 rpm. */
static const float PUSH_NM_MIN = 1.0f;

void push_note(const assist_config *config, assist_state *state, float torque_nm)
{
    state->push_steps = (uint16_t)(state->push_steps + 1u);
    if ((float)state->push_steps * config->step_s > PUSH_HALF_SECOND_S) {
        state->push_steps = 1;
        state->push_peak_nm[2] = state->push_peak_nm[1];
        state->push_peak_nm[1] = state->push_peak_nm[0];
        state->push_peak_nm[0] = 0.0f;
    }
    state->push_peak_nm[0] = float32_max(state->push_peak_nm[0], torque_nm);
}

/* An average, and a gentle ramp down, go on when the legs only turn along: not for longer. */
static int pushing(const assist_config *config, const assist_state *state)
{
    float push_nm = float32_max(state->push_peak_nm[0], state->push_peak_nm[1]);

    push_nm = float32_max(push_nm, state->push_peak_nm[2]);
    return push_nm >= float32_max(config->pedal_torque_nm_min, PUSH_NM_MIN);
}

/* Forward pedalling renews the permission, back-pedalling ends it, standing cranks use it up. */
static int turning(const assist_config *config, assist_state *state, float cadence_rpm)
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
    float band_kmh = market_cutoff_band_kmh(config);

    if (below_kmh >= band_kmh) return demand_nm;
    return held_at(demand_nm * (below_kmh / band_kmh), demand_nm, ASSIST_LIMIT_SPEED_CUTOFF,
                   output);
}

/* By bit of what cuts off, in the order of the trace. */
enum { CUT_OFFS = 5 };
static const uint16_t CUT_OFF_FLAGS[CUT_OFFS] = {ASSIST_LIMIT_PEDAL_STOP, ASSIST_LIMIT_BRAKE,
                                                 ASSIST_LIMIT_SPEED_CUTOFF,
                                                 ASSIST_LIMIT_BATTERY_VOLTAGE, ASSIST_LIMIT_FAULT};

static unsigned cut_offs_now(const assist_config *config, assist_state *state,
                             const assist_input *input)
{
    unsigned cuts = 0;

    if (!walk_is_on(state) &&
        !(turning(config, state, input->cadence_rpm) && pushing(config, state))) {
        cuts |= 1u << 0;
    }
    if (input->brake) cuts |= 1u << 1;
    if (input->speed_kmh >= market_cutoff_kmh(config)) cuts |= 1u << 2;
    if (input->battery_voltage_v < config->battery_voltage_v_min) cuts |= 1u << 3;
    if (input->inhibit) cuts |= 1u << 4;
    return cuts;
}

float apply_cutoffs(const assist_config *config, assist_state *state, const assist_input *input,
                    float demand_nm, assist_output *output, assist_trace *trace)
{
    unsigned cuts = cut_offs_now(config, state, input);
    float left_nm = demand_nm;
    unsigned index;

    if (trace) trace->cut_offs = (uint8_t)cuts;
    for (index = 0; cuts >> index != 0; ++index) {
        if (!(cuts >> index & 1u)) continue;
        left_nm = held_at(0.0f, demand_nm, CUT_OFF_FLAGS[index], output);
    }
    return left_nm;
}

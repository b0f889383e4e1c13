/* The battery's limit: 36 V times `battery_current_a_max` of power, 12 A of current below 36 V, and
 * less of both where the battery sags. Held by the firmware alone; thesis_checks I-4, I-5, A13.
 *
 * Steady state of thesis eq. 4.8 and 4.9: U = i R + K w, T = i K, so the motor takes
 * P = i (i R + K w). R is that of the winding's copper at its measured temperature; one that is not
 * measured counts as hot. Iron, bearings, bridge and the tolerance of K take a loss on top, which
 * is learned from the measured current: wherever the limit holds, or more is drawn than allowed,
 * the loss moves by the difference with a time constant of TRIM_S. It is ASSUMED_LOSS_W before
 * anything was measured (5 % of 432 W) and at least that where the current is not, never negative
 * (a current sensor that reads too little gains nothing but this margin), and at most LOSS_W_MAX.
 *
 * Held so: the mean of any second within 0.5 % of the limit. What a step cannot know is what the
 * motor does in its 10 ms: one that runs free up to its clutch may draw up to 10 % more meanwhile.
 *
 * Sag: the current goes back over SAG_BAND_V above the lowest voltage. A worn pack of 0.25 ohm
 * gives this loop a gain of one, an old and cold one two; followed with a time constant of SAG_S
 * it does not swing. At the lowest voltage there is nothing at once. */
#include "assist_steps.h" // battery_torque_nm
#include "float32.h" // float32_clamp, float32_is_finite, float32_max, float32_min, float32_sqrt
#include "heat.h"    // HEAT_MOTOR_HOT_DEGC

static const float NOMINAL_V = 36.0f;
static const float ASSUMED_LOSS_W = 22.0f;
static const float LOSS_W_MAX = 86.0f;
static const float TRIM_S = 0.25f;
static const float TRIM_SHARE_MAX = 0.5f;

static const float SAG_BAND_V = 3.0f;
static const float SAG_S = 0.04f;

static const float COPPER_SHARE_PER_K = 0.00393f;
static const float COPPER_DEGC = 20.0f;

float winding_resistance_ohm(const assist_config *config, const assist_input *input)
{
    float winding_degc = HEAT_MOTOR_HOT_DEGC;

    if (input->motor_temperature_degc < winding_degc) {
        winding_degc = float32_max(input->motor_temperature_degc, COPPER_DEGC);
    }
    return config->motor_resistance_ohm *
           (1.0f + COPPER_SHARE_PER_K * (winding_degc - COPPER_DEGC));
}

static float above_lowest_v(const assist_config *config, const assist_input *input)
{
    return input->battery_voltage_v - config->battery_voltage_v_min;
}

int battery_sags(const assist_config *config, const assist_input *input)
{
    return above_lowest_v(config, input) < SAG_BAND_V;
}

static void sag_follow(const assist_config *config, assist_state *state, const assist_input *input)
{
    float left = float32_clamp(above_lowest_v(config, input) / SAG_BAND_V, 0.0f, 1.0f);
    float share = left > 0.0f ? float32_min(config->step_s / SAG_S, 1.0f) : 1.0f;

    state->battery_spared += share * (1.0f - left - state->battery_spared);
}

/* Judges the limit of the step before by what was drawn under it. */
static void loss_learn(const assist_config *config, assist_state *state, const assist_input *input)
{
    float drawn_w = input->battery_voltage_v * input->battery_current_a;
    float spare_w = state->battery_power_w - drawn_w;
    float share = float32_min(config->step_s / TRIM_S, TRIM_SHARE_MAX);
    int held = state->assist_torque_nm >= state->battery_torque_nm * config->gear_ratio;

    if (state->battery_power_w <= 0.0f) return;
    if (!float32_is_finite(drawn_w)) {
        state->battery_trim_w = float32_min(state->battery_trim_w, 0.0f);
    } else if (held || spare_w < 0.0f) {
        state->battery_trim_w = float32_clamp(state->battery_trim_w + share * spare_w,
                                              ASSUMED_LOSS_W - LOSS_W_MAX, ASSUMED_LOSS_W);
    }
}

/* The positive root of R i^2 + K w i = P, in the form that does not subtract two near numbers. */
float battery_torque_nm(const assist_config *config, assist_state *state, const assist_input *input,
                        float resistance_ohm, float back_emf_v)
{
    float voltage_v = float32_clamp(input->battery_voltage_v, 0.0f, NOMINAL_V);
    float motor_w;
    float sum_v;

    loss_learn(config, state, input);
    sag_follow(config, state, input);
    state->battery_power_w =
        voltage_v * (config->battery_current_a_max * (1.0f - state->battery_spared));
    motor_w = float32_max(state->battery_power_w - ASSUMED_LOSS_W + state->battery_trim_w, 0.0f);
    sum_v = back_emf_v + float32_sqrt(back_emf_v * back_emf_v + 4.0f * resistance_ohm * motor_w);
    state->battery_torque_nm =
        sum_v == 0.0f ? 0.0f : config->motor_torque_constant_nm_per_a * (2.0f * motor_w / sum_v);
    return state->battery_torque_nm;
}

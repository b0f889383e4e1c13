/* The last step of the pipeline: whatever a table, a mode or a limit asks for, the motor gives no
 * more than the market allows, at every speed and not only at the points of a table. */
#include "assist_steps.h" // apply_market, held_at, torque_is_fresh, walk_is_on
#include "float32.h"      // float32_max, float32_min
#include "market.h"       // market_japan_ratio, market_profile_of

/* Continuous power is a mean. A minute is short against the half hour of a rating test (EN 60034-1,
 * S2 30 min): over it the mean passes the rating by 1 in 30, within the 5 % that is accepted. */
static const float POWER_MEAN_S = 60.0f;

/* How far above the rating a moment may lie for each watt the mean lies below it: the assist sinks
 * to the rating within seconds instead of falling. */
static const float POWER_HEADROOM = 10.0f;

static const float RAD_PER_S_PER_RPM = 0.104719755f;

/* Against the mean of a stroke and against the push of this moment, whichever is less: whoever
 * measures, over whatever time, finds no more than the ratio. An average alone outlives a push. */
static float ratio_limit_nm(const assist_config *config, const assist_state *state,
                            const assist_input *input, float push_nm)
{
    float rider_nm = torque_is_fresh(input) ? float32_min(state->turn.mean_nm, push_nm) : 0.0f;

    return market_japan_ratio(input->speed_kmh) * float32_max(rider_nm, 0.0f) / config->gear_ratio;
}

static float continuous_limit_w(const market_profile *profile, const assist_state *state)
{
    float below_w = float32_max(profile->continuous_w - state->motor_power_mean_w, 0.0f);

    return profile->continuous_w + POWER_HEADROOM * below_w;
}

float apply_market(const assist_config *config, assist_state *state, const assist_input *input,
                   float motor_nm, assist_output *output)
{
    const market_profile *profile = market_profile_of(config->market);
    float speed_rad_s = float32_max(input->motor_speed_rpm, 0.0f) * RAD_PER_S_PER_RPM;
    float speed_max_kmh = walk_is_on(state) ? profile->walk_kmh : profile->cutoff_kmh;

    if (input->speed_kmh >= speed_max_kmh) {
        motor_nm = held_at(0.0f, motor_nm, ASSIST_LIMIT_MARKET, output);
    }
    if (profile->ratio_falls) {
        motor_nm = held_at(ratio_limit_nm(config, state, input, output->rider_torque_nm), motor_nm,
                           ASSIST_LIMIT_MARKET, output);
    }
    if (speed_rad_s > 0.0f && profile->peak_w > 0.0f) {
        motor_nm = held_at(profile->peak_w / speed_rad_s, motor_nm, ASSIST_LIMIT_MARKET, output);
    }
    if (speed_rad_s > 0.0f && profile->continuous_w > 0.0f) {
        motor_nm = held_at(continuous_limit_w(profile, state) / speed_rad_s, motor_nm,
                           ASSIST_LIMIT_MARKET, output);
    }
    state->motor_power_mean_w +=
        config->step_s / POWER_MEAN_S * (motor_nm * speed_rad_s - state->motor_power_mean_w);
    return motor_nm;
}

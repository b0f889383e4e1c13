/* Walk assist: the motor pushes the bike beside a walking rider for as long as a button is held.
 *
 * EN 15194 4.2.12: by an intended action, held, to 6 km/h. It ends for good with the button, a turn
 * of the pedals, a brake, a fault or a change to a mode that is off, and then wants a new press. */
#include "assist_steps.h" // walk_follow, walk_is_on, apply_walk
#include "float32.h"      // float32_abs, float32_clamp, float32_min
#include "market.h"       // market_profile_of

enum { WALK_REFUSED = 0, WALK_RELEASED = 1, WALK_ON = 2 };

/* Tuned for what the push does: 1 Nm at the crank moves a bike of 25 kg at 0.13 km/h per second and
 * one with its rider at 0.03 (44/14, 0.33 m): damped 1.4 and 0.7 of critical. */
static const float GAIN_NM_PER_KMH = 15.0f;
static const float INTEGRAL_NM_PER_KMH_S = 4.0f;

/* Half of what the motor has: a bike that is pushed must be stoppable by hand (thesis_checks 6). */
static const float TORQUE_SHARE = 0.5f;

/* The set speed stays below the market's limit by this, or the limit would chop it. */
static const float BELOW_LIMIT_KMH = 0.3f;

/* A bike that rolls away is not walked any more. */
static const float ABOVE_LIMIT_KMH = 2.0f;

/* Pedals that hang still swing a little; a turn of them is slower than any rider's. */
static const float CADENCE_STILL_RPM = 2.0f;

int walk_is_on(const assist_state *state) { return state->walk_phase == WALK_ON; }

void walk_refuse(assist_state *state)
{
    state->walk_phase = WALK_REFUSED;
    state->walk_integral_nm = 0.0f;
}

static int may_walk(const assist_config *config, const assist_input *input, float speed_max_kmh)
{
    return config->walk_speed_kmh > 0.0f && input->speed_kmh < speed_max_kmh &&
           config->mode_laws[input->mode] != ASSIST_LAW_OFF && !input->brake && !input->inhibit &&
           float32_abs(input->cadence_rpm) < CADENCE_STILL_RPM;
}

void walk_follow(const assist_config *config, assist_state *state, const assist_input *input)
{
    float limit_kmh = market_profile_of(config->market)->walk_kmh;
    int was_on = walk_is_on(state);
    int refused;

    if (!input->walk_button) {
        state->walk_phase = WALK_RELEASED;
    } else if (state->walk_phase != WALK_REFUSED) {
        /* It begins below the limit, and goes on a little above it without any torque. */
        limit_kmh += was_on && limit_kmh > 0.0f ? ABOVE_LIMIT_KMH : 0.0f;
        refused = !may_walk(config, input, limit_kmh);
        state->walk_phase = refused ? WALK_REFUSED : WALK_ON;
    }
    if (walk_is_on(state)) {
        state->pedal_steps_left = 0; /* who walks does not pedal */
        return;
    }
    state->walk_integral_nm = 0.0f;
    if (was_on) state->assist_torque_nm = 0.0f; /* no ramp carries the push on */
}

float apply_walk(const assist_config *config, assist_state *state, const assist_input *input,
                 assist_output *output)
{
    float limit_kmh = market_profile_of(config->market)->walk_kmh - BELOW_LIMIT_KMH;
    float error_kmh = float32_min(config->walk_speed_kmh, limit_kmh) - input->speed_kmh;
    float highest_nm = TORQUE_SHARE * config->motor_torque_nm_max * config->gear_ratio;
    float summed_nm = state->walk_integral_nm + INTEGRAL_NM_PER_KMH_S * config->step_s * error_kmh;
    float wanted_nm = GAIN_NM_PER_KMH * error_kmh + summed_nm;
    float given_nm = float32_clamp(wanted_nm, 0.0f, highest_nm);

    /* No wind-up: at a limit the sum only moves back from it. */
    if (given_nm == wanted_nm || (wanted_nm > given_nm) == (error_kmh < 0.0f)) {
        state->walk_integral_nm = float32_clamp(summed_nm, 0.0f, highest_nm);
    }
    if (wanted_nm > highest_nm) output->limit_flags |= ASSIST_LIMIT_MOTOR_TORQUE;
    return given_nm;
}

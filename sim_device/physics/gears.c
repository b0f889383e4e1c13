#include "gears.h"

#include <math.h>

/* What has less is the end of the list. */
#define TEETH_MIN 1.0

static int cogs(const gears_config *config)
{
    int count = 0;
    while (count < GEARS_COGS_MAX && config->cog_teeth[count] >= TEETH_MIN) count++;
    return count;
}

double gears_cog_teeth(const gears_config *config, const gears_state *state)
{
    return config->cog_teeth[0] >= TEETH_MIN ? config->cog_teeth[state->cog] : 0.0;
}

void gears_reset(const gears_config *config, gears_state *state, double rpm, double teeth)
{
    const gears_state none = {0};
    double best = HUGE_VAL;
    *state = none;
    for (int k = cogs(config) - 1; k >= 0; k--) {
        const double off = fabs(rpm * config->cog_teeth[k] / teeth - config->cadence_rpm);
        if (off < best) state->cog = k;
        best = fmin(best, off);
    }
    state->wanted = state->cog;
}

/* A smaller cog turns the chainring slower, for the same wheel. */
static int next_cog(const gears_config *config, const gears_state *state, double chainring_rpm)
{
    const double over_rpm = chainring_rpm - config->cadence_rpm;
    const int next = over_rpm > 0.0 ? state->cog - 1 : state->cog + 1;
    if (fabs(over_rpm) <= config->hysteresis_rpm || next < 0 || next >= cogs(config)) {
        return state->cog;
    }
    const double then_rpm = chainring_rpm * config->cog_teeth[next] / config->cog_teeth[state->cog];
    const double then_over_rpm = fabs(then_rpm - config->cadence_rpm);
    const int stands = !(chainring_rpm > 0.0);
    return stands || then_over_rpm < fabs(over_rpm) ? next : state->cog;
}

void gears_step(const gears_config *config, gears_state *state, double chainring_rpm, double dt_s)
{
    if (config->cog_teeth[0] < TEETH_MIN) return;
    /* A shorter cassette is installed. */
    if (config->cog_teeth[state->cog] < TEETH_MIN) state->cog = cogs(config) - 1;
    if (state->left_s <= 0.0) {
        state->wanted = next_cog(config, state, chainring_rpm);
        if (state->wanted == state->cog) return;
        state->left_s = config->shift_s;
    }
    state->left_s = fmax(state->left_s - dt_s, 0.0);
    if (state->left_s <= 0.5 * config->shift_s) state->cog = state->wanted;
}

double gears_push_share(const gears_config *config, const gears_state *state)
{
    if (!(state->left_s > 0.0)) return 1.0;
    const double from_middle = fabs(2.0 * state->left_s / config->shift_s - 1.0);
    return 1.0 - (1.0 - from_middle) * (1.0 - config->shift_torque_share);
}

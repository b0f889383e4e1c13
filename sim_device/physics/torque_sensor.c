#include "torque_sensor.h"

#include <math.h>

/* splitmix64: every seed, zero included, starts a full-period sequence. */
static double uniform(torque_sensor_state *state)
{
    state->random += 0x9E3779B97F4A7C15u;
    uint64_t bits = state->random;
    bits = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9u;
    bits = (bits ^ (bits >> 27)) * 0x94D049BB133111EBu;
    bits ^= bits >> 31;
    return (double)(bits >> 11) / 9007199254740992.0;
}

/* Sum of twelve uniforms: standard deviation 1, and no rare value far outside an amplifier's. */
static double gaussian(torque_sensor_state *state)
{
    double sum = -6.0;
    for (int k = 0; k < 12; k++) {
        sum += uniform(state);
    }
    return sum;
}

int16_t torque_sensor_read(const torque_sensor_config *config, torque_sensor_state *state,
                           double torque_nm)
{
    double seen_nm = torque_nm * config->gain;
    if (config->noise_nm > 0.0) {
        seen_nm += config->noise_nm * gaussian(state);
    }
    const double counts = config->zero_counts + seen_nm / config->nm_per_count;
    return (int16_t)lround(fmin(fmax(counts, -32767.0), 32767.0));
}

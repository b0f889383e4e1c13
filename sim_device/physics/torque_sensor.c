#include "torque_sensor.h"

#include <math.h>

#include "noise.h" // noise_gaussian

#define PI 3.14159265358979323846
#define NOMINAL_GAUGE_FACTOR 2.0
#define S_PER_MIN 60.0

/* Half widths of the plays: pedalling, a strong stroke and a calibration each wake another one. */
static const double PLAY_NM[TORQUE_SENSOR_PLAYS] = {2.0, 8.0, 20.0};

void torque_sensor_reset(const torque_sensor_config *config, torque_sensor_state *state)
{
    const torque_sensor_state rested = {
        .board_degc = config->ambient_degc,
        .gauge_degc = config->ambient_degc,
    };
    *state = rested;
}

/* First order, stable for any step: a calibration waits half a minute in one. */
static double towards(double value, double target, double time_constant_s, double dt_s)
{
    return value + (target - value) * dt_s / (time_constant_s + dt_s);
}

static double strain_per_nm(const torque_sensor_config *config)
{
    const double bore = config->bore_diameter_m / config->shaft_diameter_m;
    const double cubed =
        config->shaft_diameter_m * config->shaft_diameter_m * config->shaft_diameter_m;
    return (1.0 + config->poisson_ratio) * 16.0 /
           (PI * cubed * config->elastic_modulus_pa * (1.0 - bore * bore * bore * bore));
}

static double v_per_nm(const torque_sensor_config *config, double gauge_factor)
{
    return config->amplifier_gain * config->bridge_v * gauge_factor * strain_per_nm(config);
}

double torque_sensor_v_per_nm(const torque_sensor_config *config)
{
    return v_per_nm(config, NOMINAL_GAUGE_FACTOR);
}

/* Each play follows only when pushed; together they lag by hysteresis_nm / 2 either way. */
static double hysteresis_nm(const torque_sensor_config *config, torque_sensor_state *state,
                            double torque_nm)
{
    double lag_nm = 0.0;
    for (int k = 0; k < TORQUE_SENSOR_PLAYS; k++) {
        state->play_nm[k] =
            fmax(torque_nm - PLAY_NM[k], fmin(torque_nm + PLAY_NM[k], state->play_nm[k]));
        const double weight = config->hysteresis_nm / (2.0 * TORQUE_SENSOR_PLAYS * PLAY_NM[k]);
        lag_nm += weight * (state->play_nm[k] - torque_nm);
    }
    return lag_nm;
}

/* What the gauges feel, as the torque that a perfect chain would have to see. */
static double felt_nm(const torque_sensor_config *config, torque_sensor_state *state,
                      double torque_nm, double crank_angle_rad, double dt_s)
{
    state->board_degc =
        towards(state->board_degc, config->ambient_degc, config->board_soak_s, dt_s);
    state->gauge_degc = towards(state->gauge_degc, state->board_degc, config->gauge_soak_s, dt_s);
    state->creep_nm =
        towards(state->creep_nm, config->creep_share * torque_nm, config->creep_s, dt_s);
    double felt = torque_nm + hysteresis_nm(config, state, torque_nm) + state->creep_nm;
    if (state->hung_nm > 0.0) {
        const double from_most_rad = crank_angle_rad - config->bending_deg * PI / 180.0;
        felt += config->bending_share * state->hung_nm * cos(from_most_rad);
    } else if (config->bending_share > 0.0) {
        felt += config->bending_share * torque_nm * cos(crank_angle_rad);
    }
    /* The left pedal is on its way down in the first half of the turn. */
    felt *= 1.0 + 0.5 * copysign(config->side_share, config->side_share * sin(crank_angle_rad));
    const double warmer_k = state->gauge_degc - config->reference_degc;
    felt *= config->gain * (1.0 + config->span_share_per_k * warmer_k);
    felt += config->zero_nm_per_k * warmer_k + config->nm_per_count * config->zero_counts;
    if (config->noise_nm > 0.0) felt += config->noise_nm * noise_gaussian(&state->random);
    return felt;
}

static int16_t converted(const torque_sensor_config *config, double felt)
{
    const double volts = config->zero_v + felt * v_per_nm(config, config->gauge_factor);
    const double codes = ldexp(1.0, (int)config->adc_bits);
    const double code = floor(volts / config->converter_v * codes + 0.5);
    if (code <= 0.0) return -TORQUE_SENSOR_COUNTS_MAX;
    if (code >= codes - 1.0) return TORQUE_SENSOR_COUNTS_MAX;
    const double seen_v = code / codes * config->converter_v - config->zero_v;
    const double counts = seen_v / torque_sensor_v_per_nm(config) / config->nm_per_count;
    return (int16_t)lround(fmin(fmax(counts, -32767.0), 32767.0));
}

int16_t torque_sensor_read(const torque_sensor_config *config, torque_sensor_state *state,
                           double torque_nm, double crank_angle_rad, int fault, double dt_s)
{
    double felt = felt_nm(config, state, torque_nm, crank_angle_rad, dt_s);
    if (fault == TORQUE_SENSOR_DRIFTING) {
        state->fault_drift_nm += config->fault_drift_nm_per_min * dt_s / S_PER_MIN;
    }
    felt += state->fault_drift_nm;
    switch (fault) {
    case TORQUE_SENSOR_STUCK: break;
    case TORQUE_SENSOR_OPEN_HIGH: state->counts = TORQUE_SENSOR_COUNTS_MAX; break;
    case TORQUE_SENSOR_OPEN_LOW: state->counts = -TORQUE_SENSOR_COUNTS_MAX; break;
    default: state->counts = converted(config, felt); break;
    }
    return state->counts;
}

int8_t torque_sensor_temperature_degc(const torque_sensor_state *state)
{
    return (int8_t)lround(fmin(fmax(state->board_degc, -127.0), 127.0));
}

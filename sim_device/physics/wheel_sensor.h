/* The wheel's speed sensor: a pulse whenever one of its magnets passes. */
#ifndef SPINDLE_WHEEL_SENSOR_H
#define SPINDLE_WHEEL_SENSOR_H

#include <stdint.h>

typedef struct {
    double pulses_per_turn; /* magnets, or teeth of a ring */
    double jitter_share;    /* standard deviation of a pulse's place, of the way between two */
} wheel_sensor_config;

typedef struct {
    double turned;      /* ways between two pulses, since the reset */
    double next;        /* place of the next pulse in them */
    double number;      /* of the next pulse */
    double pulse_age_s; /* since the latest pulse */
    uint32_t pulses;    /* that were seen; wraps */
    uint64_t noise;
} wheel_sensor_state;

/* At rest, the first magnet half a way ahead. */
void wheel_sensor_reset(wheel_sensor_state *state, uint64_t seed);

/* The wheel turns on by `turns` within `dt_s`, evenly. Of the pulses `missed_share` is not seen. */
void wheel_sensor_step(const wheel_sensor_config *config, wheel_sensor_state *state, double turns,
                       double missed_share, double dt_s);

#endif

/* The torque sensor's word: torque as a 16-bit count, with the seeded noise of the amplifier. */
#ifndef SPINDLE_TORQUE_SENSOR_H
#define SPINDLE_TORQUE_SENSOR_H

#include <stdint.h>

typedef struct {
    double nm_per_count; /* 0.01, thesis_checks I-21 */
    double zero_counts;  /* reading without load */
    double gain;         /* 1 is a true sensor; Table 3-1's rig shows 1.00419 (thesis_checks 3) */
    double noise_nm;     /* standard deviation of one reading */
    double temperature_degc;
} torque_sensor_config;

typedef struct {
    uint64_t random; /* state of the noise generator: the seed, to begin with */
} torque_sensor_state;

/* One reading of `torque_nm`, held at the ends of the 16-bit range. */
int16_t torque_sensor_read(const torque_sensor_config *config, torque_sensor_state *state,
                           double torque_nm);

#endif

/* The torque sensor: a hollow spindle, four strain gauges, an amplifier and a converter, all of
 * which turn with the crank; its reading leaves as a 16-bit count of 0.01 Nm.
 *
 * Strain: thesis eq. 3.4; bridge: eq. 3.17 with the gauge factor of I-22. Drift, noise, creep and
 * hysteresis: thesis_checks 6. Named states of a real specimen are values of this configuration. */
#ifndef SPINDLE_TORQUE_SENSOR_H
#define SPINDLE_TORQUE_SENSOR_H

#include <stdint.h>

#define TORQUE_SENSOR_PLAYS 3
#define TORQUE_SENSOR_COUNTS_MAX 32767 /* a converter at its end: no torque, a broken arm */

typedef enum {
    TORQUE_SENSOR_SOUND = 0,
    TORQUE_SENSOR_STUCK = 1,     /* the last reading for ever */
    TORQUE_SENSOR_OPEN_HIGH = 2, /* an arm of the bridge is open: the amplifier at its upper end */
    TORQUE_SENSOR_OPEN_LOW = 3,
    TORQUE_SENSOR_DRIFTING = 4 /* the zero walks away by fault_drift_nm_per_min */
} torque_sensor_fault;

typedef struct {
    double shaft_diameter_m;
    double bore_diameter_m;
    double elastic_modulus_pa;
    double poisson_ratio;
    double gauge_factor;
    double bridge_v;
    double amplifier_gain;
    double zero_v;        /* amplifier's output without load */
    double converter_v;   /* of the full scale */
    double adc_bits;      /* 12 or 16 */
    double nm_per_count;  /* 0.01, thesis_checks I-21 */
    double zero_counts;   /* reading without load */
    double gain;          /* 1 is a true sensor; Table 3-1's rig shows 1.00419 (thesis_checks 3) */
    double noise_nm;      /* standard deviation of one word */
    double bending_share; /* cross-talk of the pedal's bending moment, in phase with the crank */
    double bending_lever_m; /* from the spindle's bearing out to the middle of a pedal */
    double bending_deg;     /* how far after the crank's top a hung mass's bending is felt most */
    double side_share;      /* how much more of the left pedal's push is felt than of the right's */
    double hysteresis_nm;   /* width of the loop over full scale (Prandtl-Ishlinskii) */
    double creep_share;     /* what a held torque adds in the end */
    double creep_s;         /* first order */
    double ambient_degc;    /* where the bike is */
    double board_soak_s;    /* the rotor's thermometer follows the air */
    double gauge_soak_s;    /* the gauges on the spindle follow the thermometer */
    double reference_degc;  /* of the calibration */
    double zero_nm_per_k;   /* of this specimen */
    double span_share_per_k; /* of this specimen */
    double fault_drift_nm_per_min;
} torque_sensor_config;

typedef struct {
    uint64_t random; /* state of the noise: the seed, to begin with */
    double play_nm[TORQUE_SENSOR_PLAYS];
    double creep_nm;
    double board_degc;
    double gauge_degc;
    double fault_drift_nm;
    double hung_nm; /* bends the spindle: a mass on a pedal; 0: a rider, or nobody */
    int16_t counts; /* of the last reading */
} torque_sensor_state;

/* A rested sensor that has the temperature of the air. */
void torque_sensor_reset(const torque_sensor_config *config, torque_sensor_state *state);

/* One reading of `torque_nm` `dt_s` after the one before, with `fault` (torque_sensor_fault).
 * A converter at either end reads TORQUE_SENSOR_COUNTS_MAX of that sign. */
int16_t torque_sensor_read(const torque_sensor_config *config, torque_sensor_state *state,
                           double torque_nm, double crank_angle_rad, int fault, double dt_s);

/* The thermometer's field of the word, in whole degrees. */
int8_t torque_sensor_temperature_degc(const torque_sensor_state *state);

/* Volts at the converter per newton metre of a specimen that is as drawn. */
double torque_sensor_v_per_nm(const torque_sensor_config *config);

#endif

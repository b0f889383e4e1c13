/* What goes into the assist law, comes out of it and stays in it from step to step. */
#ifndef SPINDLE_ASSIST_TYPES_H
#define SPINDLE_ASSIST_TYPES_H

#include <stdint.h>

#include "fuzzy_table.h" // fuzzy_table

#define ASSIST_MODE_SLOTS 5
#define HALF_TURN_PARTS 16
#define ASSIST_RATE_HISTORY 64 /* control steps the torque-rate interval can span, at most */

/* Bits of limit_flags in registry.toml: which step held the motor back in this control step. A
 * cut-off is told only while there was something to cut; it clears the bits of the ramps, because
 * they no longer decide. */
#define ASSIST_LIMIT_TAPER 0x0001
#define ASSIST_LIMIT_SPEED_CUTOFF 0x0002
#define ASSIST_LIMIT_PEDAL_STOP 0x0004
#define ASSIST_LIMIT_BRAKE 0x0008
#define ASSIST_LIMIT_RAMP_UP 0x0010
#define ASSIST_LIMIT_RAMP_DOWN 0x0020
#define ASSIST_LIMIT_MOTOR_TORQUE 0x0040
#define ASSIST_LIMIT_BATTERY_CURRENT 0x0080
#define ASSIST_LIMIT_MOTOR_SPEED 0x0100
#define ASSIST_LIMIT_BATTERY_VOLTAGE 0x0200
#define ASSIST_LIMIT_INPUT_REFUSED 0x0400
#define ASSIST_LIMIT_MODE_OFF 0x0800
#define ASSIST_LIMIT_TEMPERATURE 0x1000
#define ASSIST_LIMIT_FAULT 0x2000 /* inhibited, no fresh torque reading, or a result lost */
#define ASSIST_LIMIT_MARKET 0x4000

typedef enum { ASSIST_LAW_OFF = 0, ASSIST_LAW_FIXED = 1, ASSIST_LAW_FUZZY = 2 } assist_law;

/* What evens out the two strokes of a crank turn. */
typedef enum { ASSIST_FILTER_TIME_CONSTANT = 0, ASSIST_FILTER_HALF_TURN = 1 } assist_filter;

/* How the fixed law's ratio falls with speed. The two Japanese ones are ceilings, in market.h. */
typedef enum {
    ASSIST_TAPER_SPEEDS = 0,
    ASSIST_TAPER_NONE = 1,
    ASSIST_TAPER_JAPAN_1_TO_1 = 2,
    ASSIST_TAPER_JAPAN_2_TO_1 = 3
} assist_taper;

typedef struct {
    float step_s; /* control period, 0.01 s */
    float sensor_offset_counts;
    float sensor_gain_nm_per_count;
    float sensor_offset_counts_per_k; /* NaN: none, as the two below */
    float sensor_gain_share_per_k;
    float sensor_reference_degc;
    uint8_t torque_filter; /* assist_filter */
    float torque_filter_s; /* of ASSIST_FILTER_TIME_CONSTANT */
    float torque_rate_interval_s;
    float torque_rate_floor_nm;
    uint8_t mode_laws[ASSIST_MODE_SLOTS]; /* assist_law */
    float mode_ratios[ASSIST_MODE_SLOTS];
    float fixed_taper_start_kmh;
    float fixed_taper_end_kmh;
    float assist_ramp_up_nm_per_s; /* at the crank */
    float assist_ramp_down_nm_per_s;
    float pedal_torque_nm_min;
    fuzzy_table table;
    uint8_t fuzzy_falling_torque; /* 0: rate held at zero, 1: no gain */
    float assist_cutoff_kmh;
    float assist_cutoff_band_kmh;
    float motor_torque_nm_max;
    float battery_current_a_max;
    float battery_voltage_v_min;
    float motor_speed_rpm_max;
    float pedal_stop_s;
    float gear_ratio;
    float motor_torque_constant_nm_per_a;
    float motor_resistance_ohm;
    uint8_t mode_tapers[ASSIST_MODE_SLOTS];         /* assist_taper */
    uint8_t mode_tables[ASSIST_MODE_SLOTS];         /* 0: table, 1: second_table */
    float mode_ramp_up_nm_per_s[ASSIST_MODE_SLOTS]; /* the slower of this and the ramp of all */
    float mode_ramp_down_nm_per_s[ASSIST_MODE_SLOTS];
    float mode_torque_share[ASSIST_MODE_SLOTS]; /* of motor_torque_nm_max, 0 to 1 */
    fuzzy_table second_table;
    float walk_speed_kmh;          /* 0: no walk assist */
    uint8_t market;                /* market of market.h */
    float assist_cutoff_extra_kmh; /* for a market that allows more than 25 km/h */
} assist_config;

typedef struct {
    float torque_raw_counts;
    float speed_kmh;
    float cadence_rpm;
    float motor_speed_rpm;
    float battery_voltage_v;
    float battery_current_a;      /* NaN: not measured; the battery's limit keeps a margin */
    float motor_temperature_degc; /* NaN: not measured; the battery's limit takes it as hot */
    float controller_temperature_degc;
    float sensor_temperature_degc; /* NaN: not measured; the reading is taken as it is */
    uint16_t torque_age_ms; /* since torque_raw_counts was measured; too old ends the assist */
    uint8_t mode;           /* slot 0 to 4; any other is refused */
    uint8_t brake;
    uint8_t walk_button;
    uint8_t inhibit; /* a fault forbids any torque */
} assist_input;

typedef struct {
    float rider_torque_nm;           /* calibrated, unfiltered; NaN if the input was refused */
    float rider_torque_filtered_nm;  /* averaged over the stroke */
    float torque_rate;               /* relative change over the interval, clamped to the table */
    float assist_ratio;              /* gain included, before limits */
    float fuzzy_gain;                /* NaN where the mode does not use it */
    float motor_torque_nm;           /* what the motor is told, at its shaft, after every limit */
    float motor_torque_demanded_nm;  /* asked by the mode, its band and the cut-offs, before ramps
                                     * and before what motor, heat, battery and market allow */
    float motor_torque_available_nm; /* what motor, heat, battery and back-EMF allow now; NaN where
                                      * the input was refused */
    uint16_t limit_flags;            /* bits of registry.toml limit_flags */
} assist_output;

/* Torque at the crank over its last half turn, by parts of equal angle; half_turn.c. */
typedef struct {
    float part_nm[HALF_TURN_PARTS]; /* ring: mean of each part that was turned through */
    float part_sum_nm;              /* of the part being turned through, over part_steps */
    float part_turned;              /* of that part, 0 to 1 */
    float mean_nm;
    uint16_t part_steps;
    uint8_t next;
    uint8_t known; /* parts since the crank began to turn */
} half_turn;

/* What the law remembers. Zero-initialised (`assist_state s = {0};`) is a bike at rest. */
typedef struct {
    float torque_filtered_nm;
    float torque_history_nm[ASSIST_RATE_HISTORY]; /* ring of filtered torque, one a step */
    uint16_t history_next;
    half_turn turn;
    uint16_t pedal_steps_left; /* steps assist may go on without forward pedalling; 0 at rest */
    float assist_torque_nm;    /* at the crank, after every limit: where the ramps go on from */
    float walk_integral_nm;
    uint8_t walk_phase;       /* of walk.c; 0 at rest: a held button must be let go first */
    uint16_t push_steps;      /* of the present half second of push_peak_nm */
    float push_peak_nm[3];    /* hardest push in this half second and in the two before */
    float motor_power_mean_w; /* at the shaft: what a continuous rating is held against */
    float battery_spared;     /* share of the current that a sagging battery is spared */
    float battery_power_w;    /* allowed in this step; 0 before the first */
    float battery_torque_nm;  /* the motor's, at that power */
    float battery_trim_w;     /* loss learned, less than what is assumed; at rest nothing is */
} assist_state;

#endif

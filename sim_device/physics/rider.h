/* The rider's legs, or the bench's servo: torque on the cranks. */
#ifndef SPINDLE_RIDER_H
#define SPINDLE_RIDER_H

#include <stdint.h>

typedef enum {
    RIDER_OFF = 0,      /* feet still on the pedals */
    RIDER_CONSTANT = 1, /* servo: the same torque at every angle */
    RIDER_LEGS = 2      /* two strokes a turn */
} rider_kind;

typedef struct {
    int kind;               /* rider_kind */
    double torque_nm;       /* mean over a turn; negative pedals backwards */
    double cadence_rpm_max; /* legs cannot follow faster than this, either way */
} rider_command;

/* What legs cannot do is 0 in the pinned bike: the thesis' rider is a servo (thesis_checks 6). */
typedef struct {
    double stroke_ripple;     /* 0 is an even turn, 1 has dead spots */
    double dead_spot_deg;     /* where they lie after the crank's top */
    double asymmetry;         /* how much stronger one leg is, -1 to 1 */
    double stroke_noise;      /* standard deviation from stroke to stroke */
    double still_leg_drag_nm; /* what resting legs hold the cranks back with */
    double torque_nm_max;     /* of standing legs; 0: tireless servo legs */
    double cadence_rpm_empty; /* at which no torque is left, straight between */
    double critical_power_w;  /* for ever; 0: never tires */
    double reserve_j;         /* W', above it */
    double peak_power_w;      /* with the whole reserve; straight down to the critical power */
} rider_config;

typedef struct {
    uint64_t random;
    double reserve_j;    /* left of W' */
    double stroke_share; /* of this stroke over a mean one */
    int stroke;          /* half turn of the crank, to notice the next */
} rider_state;

/* A fresh rider. */
void rider_reset(const rider_config *config, rider_state *state);

/* Driving torque at the cranks. Legs: T(1 - k cos 2 angle + a sin angle), angle 0 with the left
 * crank up (thesis_checks 4.1 and 6). Fades to nothing over the last revolutions before
 * cadence_rpm_max; never above T_max(1 - w/w0), nor above P = CP + (P_peak - CP) W/W', Morton's
 * model of three parameters (Ergonomics 39 (1996) 611). */
double rider_torque_nm(const rider_config *config, rider_state *state, const rider_command *command,
                       double crank_angle_rad, double crank_speed_rad_s);

/* Torque that holds turning cranks back, as a positive number. */
double rider_drag_nm(const rider_config *config, const rider_command *command);

/* The reserve after `dt_s` at `power_w`: spent above the critical power, refilled below it in
 * proportion to what is missing (Skiba's differential form, thesis_checks 6). */
void rider_tire(const rider_config *config, rider_state *state, double power_w, double dt_s);

#endif

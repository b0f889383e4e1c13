/* The rider's legs, or the bench's servo: torque on the cranks. */
#ifndef SPINDLE_RIDER_H
#define SPINDLE_RIDER_H

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

typedef struct {
    double stroke_ripple;     /* 0 is an even turn, 1 has dead spots */
    double still_leg_drag_nm; /* what resting legs hold the cranks back with */
} rider_config;

/* Driving torque at the cranks. Legs: T(1 - k cos 2 angle), angle 0 with the left crank up
 * (thesis_checks 4.1). Fades to nothing over the last revolutions before cadence_rpm_max. */
double rider_torque_nm(const rider_config *config, const rider_command *command,
                       double crank_angle_rad, double crank_speed_rad_s);

/* Torque that holds turning cranks back, as a positive number. */
double rider_drag_nm(const rider_config *config, const rider_command *command);

#endif

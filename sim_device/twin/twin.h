/* The same road again: a recorded ride, by distance, ridden by the law with another table.
 *
 * What a ride tells of its road (the force that held the bike), of its rider (torque, cadence,
 * where it stopped) and of its bike is laid over the distance; the bike's speed, the law and the
 * rider's answer to another speed then follow step by step. The law is the unit's own.
 * m dv/dt = F_drive - F0(x) - 1/2 rho CdA v^2, F_drive = eta_c (T_rider + eta_g G T_motor) / r. */
#ifndef SPINDLE_TWIN_H
#define SPINDLE_TWIN_H

#include <stddef.h>
#include <stdint.h>

#include "assist_types.h" // assist_config

#define TWIN_LIMITS 16 /* bits of limit_flags */

/* At equal distances from the start of the ride; `count` numbers each. */
typedef struct {
    double spacing_m;
    size_t count;
    const double *force_n;     /* what holds the bike besides the air: grade, rolling, mean wind */
    const double *rider_nm;    /* at the cranks, as recorded */
    const double *speed_ms;    /* as recorded */
    const double *ceiling_ms;  /* above it the rider brakes; infinite where nothing says so */
    const double *stand_s;     /* how long the bike stands when it gets here; mostly 0 */
    const double *reach_m;     /* metres a radian of the chainring */
    const double *crank_share; /* the cranks' speed over the chainring's, 0 to 1 */
    const double *motor_degc;
    const double *controller_degc;
    const uint8_t *mode;
    const uint8_t *braking; /* the lever was pulled here, or the bike slowed as if it was */
} twin_road;

typedef struct {
    double mass_kg;         /* all that moves, wheels included */
    double air_n_s2_per_m2; /* 1/2 rho CdA */
    double chain_efficiency;
    double gear_efficiency;
    double open_v;      /* of the battery at the start */
    double sag_v_per_j; /* of the energy that was taken */
    double resistance_ohm;
    double loss_w_per_rad2; /* electrical power a w^2 + b T w + c T^2 of the motor, with a, */
    double power_share;     /* b, */
    double loss_w_per_nm2;  /* and c; and what the controller takes alone */
    double idle_w;
} twin_bike;

/* How the rider answers another speed. power_share 1: pushes less the faster the cranks turn, the
 * same power; 0: the same torque. hold_share 1: pushes as hard as the recorded speed needs.
 * cadence_share 1: shifts so that the cranks turn as recorded; 0: the recorded gear stays. */
typedef struct {
    double power_share;
    double hold_share;
    double cadence_share;
} twin_rider;

typedef struct {
    double t_s;
    double distance_m;
    double speed_ms;
    double rider_nm;
    double motor_nm; /* at its shaft */
    uint16_t limit_flags;
} twin_sample;

typedef struct {
    double duration_s;
    double motor_work_j; /* at its shaft */
    double battery_j;
    double rider_work_j;
    double moving_s;
    double ripple_nm2_per_s;     /* (dT/dt)^2 dt of the motor's torque while the bike moves */
    double crawling_s;           /* below 1.5 m/s and not standing: a real rider may not make it */
    double limit_s[TWIN_LIMITS]; /* while it moves, by bit of limit_flags */
    int gave_up; /* stood where the recorded ride did not, or outlasted the time given */
    size_t samples;
} twin_ride_totals;

/* Rides to the end of the road or for `longest_s`. Where the road does not begin with a stop, the
 * law begins with what it would remember of a road like the first five seconds of this one. One
 * sample every `sample_steps` control steps goes into `samples` as long as there is room for it. */
void twin_ride(const twin_road *road, const twin_bike *bike, const twin_rider *rider,
               const assist_config *law, double longest_s, size_t sample_steps,
               twin_sample *samples, size_t capacity, twin_ride_totals *totals);

#endif

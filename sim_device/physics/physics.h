/* The bike around the drive unit: one call per millisecond, state in the caller's struct.
 *
 * Knows nothing of the firmware: torque demand in, what sensors could see out. Energy is booked in
 * a ledger as it flows, so that every run can say by how much its books fail to close. */
#ifndef SPINDLE_PHYSICS_H
#define SPINDLE_PHYSICS_H

#include <stdint.h>

#include "battery.h"       // battery_config
#include "drivetrain.h"    // drivetrain_config
#include "gears.h"         // gears_config
#include "hung_mass.h"     // hung_mass
#include "ledger.h"        // physics_ledger
#include "motor.h"         // motor_config
#include "motor_foc.h"     // motor_foc_state
#include "rider.h"         // rider_command
#include "road.h"          // road_command
#include "rotor_link.h"    // rotor_link_config
#include "torque_sensor.h" // torque_sensor_config
#include "wheel_sensor.h"  // wheel_sensor_config

typedef struct {
    road_config road;
    drivetrain_config drivetrain;
    gears_config gears;
    motor_config motor;
    battery_config battery;
    rider_config rider;
    torque_sensor_config sensor;
    rotor_link_config link;
    wheel_sensor_config wheel;
} physics_config;

typedef enum { SPEED_SENSOR_SOUND = 0, SPEED_SENSOR_LOST = 1, SPEED_SENSOR_STUCK = 2 } speed_fault;

/* What is broken; all zero is a sound bike. */
typedef struct {
    int torque_sensor;          /* torque_sensor_fault */
    int speed_sensor;           /* speed_fault */
    int link_lost;              /* no carrier between spindle and housing */
    int motor_hall;             /* the motor does not know where its rotor is, and stands still */
    int battery_cut;            /* the battery's management opens its switch */
    double motor_warmer_k;      /* what the motor's thermometer shows too much */
    double controller_warmer_k; /* and the controller's */
    double pulses_missed;       /* share of the wheel's pulses that nobody sees */
} physics_faults;

typedef struct {
    rider_command rider;
    road_command road;
    physics_faults faults;
    hung_mass hung;         /* while the wheel is held (road.held): nobody rides then */
    double motor_torque_nm; /* at the motor's shaft */
} physics_command;

typedef struct {
    double t_s;
    double distance_m;
    double height_m;
    double speed_ms;
    double wheel_speed_ms;    /* of the rear tyre; more than speed_ms while it slips */
    double chain_ratio;       /* wheel turns per crank turn, in this gear */
    double crank_speed_rad_s; /* negative backwards */
    double crank_angle_rad;   /* 0 to 2 pi */
    double motor_speed_rad_s;
    double spindle_torque_nm; /* what passes the strain gauges */
    double motor_shaft_nm;    /* through its clutch, so never negative */
    double motor_current_a;
    double seen_speed_ms; /* that the speed sensor makes pulses of, at the wheel */
    double seen_speed_age_s;
    int crank_engaged;
    int motor_engaged;
    int slipping;
    double hung_s; /* since a mass was hung on a pedal */
    uint32_t steps;
    gears_state gears;
    motor_heat heat;
    motor_foc_state foc;
    battery_state battery;
    rider_state rider;
    torque_sensor_state sensor;
    rotor_link_state link;
    wheel_sensor_state wheel;
    physics_ledger ledger;
} physics_state;

/* The pinned bike W1 of thesis_checks 4.7 with the motor of I-5. */
void physics_default(physics_config *config);

/* A bike rolling at `speed_kmh` with cranks and motor turning along. */
void physics_reset(const physics_config *config, physics_state *state, double speed_kmh,
                   uint64_t seed);

/* Starts the noise of legs, sensor and link afresh; everything else goes on. */
void physics_seed(physics_state *state, uint64_t seed);

/* A fresh battery, rider and sensor at the air's temperature, in a gear that suits the speed; the
 * bike rolls on. */
void physics_renew(const physics_config *config, physics_state *state);

/* One step of `dt_s` (0.001). Velocity first, then position with the mean velocity of the step,
 * so that work and kinetic energy agree to rounding. Every second step ends with an exchange of the
 * rotor link. */
void physics_step(const physics_config *config, physics_state *state,
                  const physics_command *command, double dt_s);

/* Puts the bike on a workbench: all of it stands, the cranks as `hung` says, and the mass begins to
 * swing. The books start afresh. */
void physics_hang(const physics_config *config, physics_state *state, const hung_mass *hung);

/* Starts the books afresh; needed after the configuration changed under a moving bike. */
void physics_begin_ledger(const physics_config *config, physics_state *state);

/* |work in - change of stored energy - losses| over work in, so far; NaN below a joule. */
double physics_energy_balance_error_pct(const physics_config *config, const physics_state *state);

/* 0 where the run follows a printed equation that does not conserve energy: I-9, I-11. */
int physics_is_energy_consistent(const physics_config *config);

/* Of the cog that the chain is on. */
double physics_cog_teeth(const physics_config *config, const physics_state *state);

/* Rotation at `speed_kmh` with everything engaged, without a cassette (thesis eq. 2.7 to 2.9). */
typedef struct {
    double wheel_rpm;
    double crank_rpm;
    double motor_rpm;
} physics_kinematics;
physics_kinematics physics_kinematics_at(const physics_config *config, double speed_kmh);

#endif

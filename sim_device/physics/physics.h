/* The bike around the drive unit: one call per millisecond, state in the caller's struct.
 *
 * Knows nothing of the firmware: torque demand in, what sensors could see out. Energy is booked in
 * a ledger as it flows, so that every run can say by how much its books fail to close. */
#ifndef SPINDLE_PHYSICS_H
#define SPINDLE_PHYSICS_H

#include <stdint.h>

#include "battery.h"       // battery_config
#include "drivetrain.h"    // drivetrain_config
#include "motor.h"         // motor_config
#include "rider.h"         // rider_command
#include "road.h"          // road_command
#include "torque_sensor.h" // torque_sensor_config

typedef struct {
    road_config road;
    drivetrain_config drivetrain;
    motor_config motor;
    battery_config battery;
    rider_config rider;
    torque_sensor_config sensor;
} physics_config;

typedef struct {
    rider_command rider;
    road_command road;
    double motor_torque_nm; /* at the motor's shaft */
} physics_command;

/* Joules since the last physics_begin_ledger. */
typedef struct {
    double rider_work_j;
    double motor_electric_j; /* from the battery's terminals */
    double kinetic_start_j;
    double potential_j;
    double copper_j;
    double motor_friction_j;
    double gear_j;
    double chain_j;
    double clutch_j;
    double legs_j;
    double rolling_j;
    double air_j;
    double brake_j;
    double dyno_j;
} physics_ledger;

typedef struct {
    double t_s;
    double distance_m;
    double height_m;
    double speed_ms;
    double crank_speed_rad_s; /* negative backwards */
    double crank_angle_rad;   /* 0 to 2 pi */
    double motor_speed_rad_s;
    double spindle_torque_nm; /* what passes the strain gauges */
    double motor_shaft_nm;
    double motor_current_a;
    double motor_temperature_degc;
    int crank_engaged;
    int motor_engaged;
    int16_t torque_counts;
    battery_state battery;
    torque_sensor_state sensor;
    physics_ledger ledger;
} physics_state;

/* The pinned bike W1 of thesis_checks 4.7 with the motor of I-5. */
void physics_default(physics_config *config);

/* A bike rolling at `speed_kmh` with cranks and motor turning along. */
void physics_reset(const physics_config *config, physics_state *state, double speed_kmh,
                   uint64_t seed);

/* One step of `dt_s` (0.001). Velocity first, then position with the mean velocity of the step,
 * so that work and kinetic energy agree to rounding. */
void physics_step(const physics_config *config, physics_state *state,
                  const physics_command *command, double dt_s);

/* Starts the books afresh; needed after the configuration changed under a moving bike. */
void physics_begin_ledger(const physics_config *config, physics_state *state);

/* |work in - change of kinetic and potential energy - losses| over work in; NaN below a joule. */
double physics_energy_balance_error_pct(const physics_config *config, const physics_state *state);

/* Rotation at `speed_kmh` with everything engaged (thesis eq. 2.7 to 2.9). */
typedef struct {
    double wheel_rpm;
    double crank_rpm;
    double motor_rpm;
} physics_kinematics;
physics_kinematics physics_kinematics_at(const physics_config *config, double speed_kmh);

#endif

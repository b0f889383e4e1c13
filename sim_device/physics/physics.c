#include "physics.h"

#include <math.h>

#define PI 3.14159265358979323846
#define RPM_PER_RAD_S (30.0 / PI)
#define KMH_PER_MS 3.6

/* Metres the bike moves per radian of the chainring. */
static double metres_per_rad(const physics_config *config)
{
    return config->road.wheel_radius_m * drivetrain_chain_ratio(&config->drivetrain);
}

static double bike_inertia_kg_m2(const physics_config *config)
{
    const double reach_m = metres_per_rad(config);
    return road_moving_mass_kg(&config->road) * reach_m * reach_m;
}

typedef struct {
    double speed;
    double travel; /* mean speed times the time it moved: work by a constant force is exact */
} motion;

/* Constant acceleration for `dt_s`; ends at rest where friction would turn it round. */
static motion advance(double speed, double acceleration, double dt_s, int friction_stops)
{
    motion after = {speed + acceleration * dt_s, 0.0};
    double moved_s = dt_s;
    if (friction_stops && speed != 0.0 && speed * after.speed <= 0.0) {
        moved_s = -speed / acceleration;
        after.speed = 0.0;
    }
    after.travel = 0.5 * (speed + after.speed) * moved_s;
    return after;
}

typedef struct {
    road_forces road;
    motor_drive motor;
    double rider_nm;
    double leg_drag_nm;
    drivetrain_flow flow;
    motion chainring;
    motion crank;
    motion motor_shaft;
} instant;

/* A free motor gains up to 14 rad/s in one step, and its limits hold at the end of it too. */
static double motor_speed_to_limit(const physics_config *config, const physics_state *state,
                                   double demand_nm, int engaged, double dt_s)
{
    if (engaged || !(demand_nm > 0.0)) {
        return state->motor_speed_rad_s;
    }
    const double torque_nm = fmin(demand_nm, config->motor.torque_nm_max);
    return state->motor_speed_rad_s + dt_s * torque_nm / config->motor.inertia_kg_m2;
}

static void gather(const physics_config *config, const physics_state *state,
                   const physics_command *command, double dt_s, instant *now)
{
    const double reach_m = metres_per_rad(config);
    const double chainring_rad_s = state->speed_ms / reach_m;
    now->road = road_forces_at(&config->road, &command->road, state->speed_ms,
                               drivetrain_chain_ratio(&config->drivetrain),
                               config->drivetrain.chain_efficiency);
    const int motor_engaged =
        state->motor_speed_rad_s >= chainring_rad_s * config->drivetrain.gear_ratio;
    const double motor_rad_s =
        motor_speed_to_limit(config, state, command->motor_torque_nm, motor_engaged, dt_s);
    now->motor = motor_drive_at(&config->motor, command->motor_torque_nm, motor_rad_s,
                                state->battery.voltage_v);
    now->rider_nm = rider_torque_nm(&config->rider, &command->rider, state->crank_angle_rad,
                                    state->crank_speed_rad_s);
    now->leg_drag_nm = 0.0;
    if (state->crank_speed_rad_s != 0.0) {
        now->leg_drag_nm =
            copysign(rider_drag_nm(&config->rider, &command->rider), state->crank_speed_rad_s);
    }
    const drivetrain_load load = {
        .bike_inertia_kg_m2 = bike_inertia_kg_m2(config),
        .pull_nm = (now->road.grade_n + now->road.air_n) * reach_m,
        .friction_nm = (now->road.rolling_n + now->road.brake_n + now->road.dyno_n) * reach_m,
        .crank_nm = now->rider_nm - now->leg_drag_nm,
        .motor_shaft_nm = now->motor.shaft_torque_nm,
        .motor_inertia_kg_m2 = config->motor.inertia_kg_m2,
        .moving = state->speed_ms > 0.0,
        .crank_engaged = state->crank_speed_rad_s >= chainring_rad_s,
        .motor_engaged = motor_engaged,
    };
    now->flow = drivetrain_solve(&config->drivetrain, &load);
}

static void move(const physics_config *config, const physics_state *state, double dt_s,
                 instant *now)
{
    const double ratio = config->drivetrain.gear_ratio;
    const double chainring_rad_s = state->speed_ms / metres_per_rad(config);
    now->chainring = advance(chainring_rad_s, now->flow.acceleration_rad_s2, dt_s, 1);
    now->crank = now->chainring;
    if (!now->flow.crank_engaged) {
        const double alpha =
            (now->rider_nm - now->leg_drag_nm) / config->drivetrain.crank_inertia_kg_m2;
        now->crank = advance(state->crank_speed_rad_s, alpha, dt_s, now->leg_drag_nm != 0.0);
    }
    now->motor_shaft.speed = now->chainring.speed * ratio;
    now->motor_shaft.travel = now->chainring.travel * ratio;
    if (!now->flow.motor_engaged) {
        const double alpha = now->motor.shaft_torque_nm / config->motor.inertia_kg_m2;
        now->motor_shaft = advance(state->motor_speed_rad_s, alpha, dt_s, 0);
    }
}

/* Two parts meet and turn on together: momentum stays, the rest of the energy is heat. */
static double meet(double inertia, double *speed, double other_inertia, double other_speed)
{
    const double slip = other_speed - *speed;
    *speed += slip * other_inertia / (inertia + other_inertia);
    return 0.5 * slip * slip * inertia * other_inertia / (inertia + other_inertia);
}

/* A free crank or motor that has become faster than the chainring drops into its clutch. */
static void close_clutches(const physics_config *config, physics_state *state, instant *now)
{
    const double ratio = config->drivetrain.gear_ratio;
    const double crank_inertia = config->drivetrain.crank_inertia_kg_m2;
    const double motor_inertia = config->motor.inertia_kg_m2 * ratio * ratio;
    double inertia = bike_inertia_kg_m2(config);
    inertia += now->flow.crank_engaged ? crank_inertia : 0.0;
    inertia += now->flow.motor_engaged ? motor_inertia : 0.0;
    state->crank_engaged = now->flow.crank_engaged;
    state->motor_engaged = now->flow.motor_engaged;
    double speed = now->chainring.speed;
    if (!state->crank_engaged && now->crank.speed > speed) {
        state->ledger.clutch_j += meet(inertia, &speed, crank_inertia, now->crank.speed);
        inertia += crank_inertia;
        state->crank_engaged = 1;
    }
    if (!state->motor_engaged && now->motor_shaft.speed > speed * ratio) {
        state->ledger.clutch_j +=
            meet(inertia, &speed, motor_inertia, now->motor_shaft.speed / ratio);
        state->motor_engaged = 1;
    }
    state->speed_ms = speed * metres_per_rad(config);
    /* Taken back from the bike's speed, so that an engaged part compares equal in the next step. */
    const double chainring_rad_s = state->speed_ms / metres_per_rad(config);
    state->crank_speed_rad_s = state->crank_engaged ? chainring_rad_s : now->crank.speed;
    state->motor_speed_rad_s =
        state->motor_engaged ? chainring_rad_s * ratio : now->motor_shaft.speed;
}

static void book(const physics_config *config, physics_ledger *ledger, const instant *now,
                 double dt_s)
{
    const double chainring_rad = now->chainring.travel;
    const double travel_m = chainring_rad * metres_per_rad(config);
    const double gear_out_nm = config->drivetrain.gear_efficiency * now->flow.motor_nm;
    const double chain_in_nm = now->flow.crank_nm + gear_out_nm;
    ledger->rider_work_j += now->rider_nm * now->crank.travel;
    ledger->legs_j += now->leg_drag_nm * now->crank.travel;
    ledger->motor_electric_j += now->motor.electromagnetic_torque_nm * now->motor_shaft.travel +
                                now->motor.copper_loss_w * dt_s;
    ledger->copper_j += now->motor.copper_loss_w * dt_s;
    ledger->motor_friction_j += now->motor.friction_torque_nm * now->motor_shaft.travel;
    ledger->gear_j += (now->flow.motor_nm - gear_out_nm) * chainring_rad;
    ledger->chain_j += (1.0 - config->drivetrain.chain_efficiency) * chain_in_nm * chainring_rad;
    ledger->potential_j += now->road.grade_n * travel_m;
    ledger->air_j += now->road.air_n * travel_m;
    ledger->rolling_j += now->road.rolling_n * travel_m;
    ledger->brake_j += now->road.brake_n * travel_m;
    ledger->dyno_j += now->road.dyno_n * travel_m;
}

void physics_step(const physics_config *config, physics_state *state,
                  const physics_command *command, double dt_s)
{
    instant now = {0};
    gather(config, state, command, dt_s, &now);
    move(config, state, dt_s, &now);
    close_clutches(config, state, &now);
    book(config, &state->ledger, &now, dt_s);

    const double travel_m = now.chainring.travel * metres_per_rad(config);
    state->t_s += dt_s;
    state->distance_m += travel_m;
    state->height_m += travel_m * sin(command->road.grade_deg * PI / 180.0);
    state->crank_angle_rad = fmod(state->crank_angle_rad + now.crank.travel, 2.0 * PI);
    state->crank_angle_rad += state->crank_angle_rad < 0.0 ? 2.0 * PI : 0.0;
    state->spindle_torque_nm = now.flow.crank_nm;
    state->motor_shaft_nm =
        now.motor.electromagnetic_torque_nm > 0.0 ? now.motor.shaft_torque_nm : 0.0;
    state->motor_current_a = now.motor.current_a;
    const double motor_rad_s = now.motor_shaft.travel / dt_s;
    const double friction_w = now.motor.friction_torque_nm * motor_rad_s;
    state->motor_temperature_degc = motor_temperature_after(
        &config->motor, state->motor_temperature_degc, now.motor.copper_loss_w + friction_w, dt_s);
    const double electric_w =
        now.motor.electromagnetic_torque_nm * motor_rad_s + now.motor.copper_loss_w;
    battery_step(&config->battery, &state->battery, electric_w, dt_s);
    state->torque_counts = torque_sensor_read(&config->sensor, &state->sensor, now.flow.crank_nm);
}

static double kinetic_j(const physics_config *config, const physics_state *state)
{
    const double mass_kg = road_moving_mass_kg(&config->road);
    const double crank_inertia = config->drivetrain.crank_inertia_kg_m2;
    return 0.5 * mass_kg * state->speed_ms * state->speed_ms +
           0.5 * crank_inertia * state->crank_speed_rad_s * state->crank_speed_rad_s +
           0.5 * config->motor.inertia_kg_m2 * state->motor_speed_rad_s * state->motor_speed_rad_s;
}

void physics_begin_ledger(const physics_config *config, physics_state *state)
{
    const physics_ledger empty = {0};
    state->ledger = empty;
    state->ledger.kinetic_start_j = kinetic_j(config, state);
}

double physics_energy_balance_error_pct(const physics_config *config, const physics_state *state)
{
    const physics_ledger *ledger = &state->ledger;
    const double in_j = ledger->rider_work_j + ledger->motor_electric_j;
    if (in_j < 1.0) {
        return (double)NAN;
    }
    const double losses_j = ledger->copper_j + ledger->motor_friction_j + ledger->gear_j +
                            ledger->chain_j + ledger->clutch_j + ledger->legs_j +
                            ledger->rolling_j + ledger->air_j + ledger->brake_j + ledger->dyno_j;
    const double stored_j =
        kinetic_j(config, state) - ledger->kinetic_start_j + ledger->potential_j;
    return 100.0 * fabs(in_j - stored_j - losses_j) / in_j;
}

physics_kinematics physics_kinematics_at(const physics_config *config, double speed_kmh)
{
    const double wheel_rad_s = speed_kmh / KMH_PER_MS / config->road.wheel_radius_m;
    const double crank_rad_s = wheel_rad_s / drivetrain_chain_ratio(&config->drivetrain);
    const physics_kinematics turning = {
        wheel_rad_s * RPM_PER_RAD_S,
        crank_rad_s * RPM_PER_RAD_S,
        crank_rad_s * config->drivetrain.gear_ratio * RPM_PER_RAD_S,
    };
    return turning;
}

void physics_reset(const physics_config *config, physics_state *state, double speed_kmh,
                   uint64_t seed)
{
    const physics_state rest = {0};
    *state = rest;
    state->speed_ms = speed_kmh / KMH_PER_MS;
    state->crank_speed_rad_s = state->speed_ms / metres_per_rad(config);
    state->motor_speed_rad_s = state->crank_speed_rad_s * config->drivetrain.gear_ratio;
    state->motor_temperature_degc = config->motor.ambient_degc;
    state->sensor.random = seed;
    battery_reset(&config->battery, &state->battery);
    physics_begin_ledger(config, state);
}

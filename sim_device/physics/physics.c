#include "physics.h"

#include <math.h>

#define PI 3.14159265358979323846
#define DEG_PER_RAD (180.0 / PI)
#define RPM_PER_RAD_S (30.0 / PI)
#define KMH_PER_MS 3.6

/* Keep the noises of one seed apart. */
#define LEGS_STREAM 0x6C6567732E6C6567u
#define WHEEL_STREAM 0x776865656C2E7073u
#define LINK_STREAM 0x6C696E6B726F746Fu

double physics_cog_teeth(const physics_config *config, const physics_state *state)
{
    const double of_cassette = gears_cog_teeth(&config->gears, &state->gears);
    return of_cassette > 0.0 ? of_cassette : config->drivetrain.cog_teeth;
}

/* Metres the rear tyre moves per radian of the chainring. */
static double metres_per_rad(const physics_config *config, const physics_state *state)
{
    return config->road.wheel_radius_m * state->chain_ratio;
}

/* What turns with the chainring: the whole bike, or only its rear wheel while the tyre slips. */
static double wheel_inertia_kg_m2(const physics_config *config, const physics_state *state,
                                  int slipping)
{
    const double reach_m = metres_per_rad(config, state);
    const double mass_kg =
        slipping ? road_rear_wheel_mass_kg(&config->road) : road_moving_mass_kg(&config->road);
    return mass_kg * reach_m * reach_m;
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
    double electric_w; /* of winding and shaft */
    double switching_w;
    double standby_w;
    double gear_drag_nm;
    double rider_nm;
    double leg_drag_nm;
    double grip_n;
    int slipping;
    drivetrain_flow flow;
    motion chainring;
    motion bike;
    motion crank;
    motion motor_shaft;
} instant;

static motor_drive motor_pull(const physics_config *config, physics_state *state,
                              const physics_command *command, int engaged, double dt_s)
{
    const battery_source source = state->battery.source;
    const double winding_degc = state->heat.winding_degc;
    const double demand_nm = command->faults.motor_hall ? 0.0 : command->motor_torque_nm;
    const motor_rotor rotor = {
        .speed_rad_s = state->motor_speed_rad_s,
        .gain_rad_s_per_nm = engaged ? 0.0 : dt_s / config->motor.inertia_kg_m2,
    };
    if (config->motor.model == MOTOR_FOC) {
        return motor_foc_drive(&config->motor, &state->foc, demand_nm, rotor, source, winding_degc,
                               dt_s);
    }
    return motor_drive_at(&config->motor, demand_nm, rotor, source, winding_degc);
}

static drivetrain_load load_of(const physics_config *config, const physics_state *state,
                               const instant *now, double chainring_rad_s, int slipping)
{
    const double reach_m = metres_per_rad(config, state);
    const road_forces *road = &now->road;
    const double pull_n = slipping ? now->grip_n : road->grade_n + road->air_n;
    const double friction_n = slipping ? 0.0 : road->rolling_n + road->brake_n + road->dyno_n;
    const drivetrain_load load = {
        .bike_inertia_kg_m2 = wheel_inertia_kg_m2(config, state, slipping),
        .pull_nm = pull_n * reach_m,
        .friction_nm = friction_n * reach_m,
        .crank_nm = now->rider_nm - now->leg_drag_nm,
        .motor_shaft_nm = now->motor.shaft_torque_nm - now->gear_drag_nm,
        .motor_inertia_kg_m2 = config->motor.inertia_kg_m2,
        .moving = slipping || state->speed_ms > 0.0,
        .crank_engaged = state->crank_speed_rad_s >= chainring_rad_s,
        .motor_engaged =
            state->motor_speed_rad_s >= chainring_rad_s * config->drivetrain.gear_ratio,
    };
    return load;
}

/* The tyre lets go when what drives the wheel would have to push with more than its grip. A bike
 * that nothing drives does not: on ice uphill it stands with a foot down. */
static int tyre_lets_go(const physics_config *config, const physics_state *state,
                        const instant *now)
{
    const drivetrain_flow *flow = &now->flow;
    const double reach_m = metres_per_rad(config, state);
    const double drive_nm = drivetrain_wheel_nm(&config->drivetrain, flow);
    const double wheel_n =
        road_rear_wheel_mass_kg(&config->road) * flow->acceleration_rad_s2 * reach_m;
    return drive_nm / reach_m - wheel_n - now->road.brake_n > now->grip_n;
}

static void gather(const physics_config *config, physics_state *state,
                   const physics_command *command, double dt_s, instant *now)
{
    const double chainring_rad_s = state->wheel_speed_ms / metres_per_rad(config, state);
    now->road = road_forces_at(&config->road, &command->road, state->speed_ms, state->chain_ratio,
                               config->drivetrain.chain_efficiency);
    const int motor_engaged =
        state->motor_speed_rad_s >= chainring_rad_s * config->drivetrain.gear_ratio;
    now->motor = motor_pull(config, state, command, motor_engaged, dt_s);
    now->gear_drag_nm = state->motor_speed_rad_s > 0.0 ? config->drivetrain.gear_drag_nm : 0.0;
    now->rider_nm = rider_torque_nm(&config->rider, &state->rider, &command->rider,
                                    state->crank_angle_rad, state->crank_speed_rad_s);
    now->rider_nm *= gears_push_share(&config->gears, &state->gears);
    state->sensor.hung_nm = 0.0;
    if (command->road.held) {
        const hung_load hung = hung_mass_load(&command->hung, config->road.gravity_m_s2,
                                              config->sensor.bending_lever_m, state->hung_s);
        now->rider_nm = hung.torque_nm;
        state->sensor.hung_nm = hung.bending_nm;
    }
    now->leg_drag_nm = 0.0;
    if (state->crank_speed_rad_s != 0.0) {
        now->leg_drag_nm =
            copysign(rider_drag_nm(&config->rider, &command->rider), state->crank_speed_rad_s);
    }
    now->grip_n = road_grip_n(&config->road, &command->road);
    now->slipping = state->slipping;
    drivetrain_load load = load_of(config, state, now, chainring_rad_s, now->slipping);
    now->flow = drivetrain_solve(&config->drivetrain, &load);
    if (!now->slipping && tyre_lets_go(config, state, now)) {
        now->slipping = 1;
        load = load_of(config, state, now, chainring_rad_s, 1);
        now->flow = drivetrain_solve(&config->drivetrain, &load);
    }
}

static void move(const physics_config *config, const physics_state *state, double dt_s,
                 instant *now)
{
    const double ratio = config->drivetrain.gear_ratio;
    const double reach_m = metres_per_rad(config, state);
    const double chainring_rad_s = state->wheel_speed_ms / reach_m;
    now->chainring = advance(chainring_rad_s, now->flow.acceleration_rad_s2, dt_s, 1);
    now->bike.speed = now->chainring.speed * reach_m;
    now->bike.travel = now->chainring.travel * reach_m;
    if (now->slipping) {
        const double outer_kg =
            road_moving_mass_kg(&config->road) - road_rear_wheel_mass_kg(&config->road);
        const double held_n =
            now->road.grade_n + now->road.air_n + now->road.rolling_n + now->road.brake_n;
        const double net_n = now->grip_n - held_n;
        /* On ice uphill the grip may not do: the bike stands with a foot down. */
        const double bike_ms2 =
            state->speed_ms > 0.0 ? net_n / outer_kg : fmax(net_n, 0.0) / outer_kg;
        now->bike = advance(state->speed_ms, bike_ms2, dt_s, 1);
    }
    now->crank = now->chainring;
    if (!now->flow.crank_engaged) {
        const double alpha =
            (now->rider_nm - now->leg_drag_nm) / config->drivetrain.crank_inertia_kg_m2;
        now->crank = advance(state->crank_speed_rad_s, alpha, dt_s, now->leg_drag_nm != 0.0);
    }
    now->motor_shaft.speed = now->chainring.speed * ratio;
    now->motor_shaft.travel = now->chainring.travel * ratio;
    if (!now->flow.motor_engaged) {
        const double torque_nm = now->motor.shaft_torque_nm - now->gear_drag_nm;
        const double alpha = torque_nm / config->motor.inertia_kg_m2;
        now->motor_shaft = advance(state->motor_speed_rad_s, alpha, dt_s, torque_nm < 0.0);
    }
}

/* Two parts meet and turn on together: momentum stays, the rest of the energy is heat. */
static double meet(double inertia, double *speed, double other_inertia, double other_speed)
{
    const double slip = other_speed - *speed;
    *speed += slip * other_inertia / (inertia + other_inertia);
    return 0.5 * slip * slip * inertia * other_inertia / (inertia + other_inertia);
}

/* A slipping wheel that is no faster than the road grips again, with all that turns along. */
static void close_grip(const physics_config *config, physics_state *state, instant *now,
                       double *inertia, double *chainring_rad_s)
{
    const double reach_m = metres_per_rad(config, state);
    state->slipping = now->slipping && *chainring_rad_s * reach_m > now->bike.speed;
    if (!now->slipping || state->slipping) {
        return;
    }
    const double outer_kg =
        road_moving_mass_kg(&config->road) - road_rear_wheel_mass_kg(&config->road);
    const double outer = outer_kg * reach_m * reach_m;
    state->ledger.slip_j += meet(*inertia, chainring_rad_s, outer, now->bike.speed / reach_m);
    *inertia += outer;
}

/* A crank or rotor that is free and faster than the chainring drops into its clutch. */
static void drop_in(const physics_config *config, physics_state *state, double inertia,
                    double chainring_rad_s, double crank_rad_s, double motor_rad_s)
{
    const double ratio = config->drivetrain.gear_ratio;
    const double crank_inertia = config->drivetrain.crank_inertia_kg_m2;
    const double motor_inertia = config->motor.inertia_kg_m2 * ratio * ratio;
    double speed = chainring_rad_s;
    if (!state->crank_engaged && crank_rad_s > speed) {
        state->ledger.clutch_j += meet(inertia, &speed, crank_inertia, crank_rad_s);
        inertia += crank_inertia;
        state->crank_engaged = 1;
    }
    if (!state->motor_engaged && motor_rad_s > speed * ratio) {
        state->ledger.clutch_j += meet(inertia, &speed, motor_inertia, motor_rad_s / ratio);
        state->motor_engaged = 1;
    }
    state->wheel_speed_ms = speed * metres_per_rad(config, state);
    /* Taken back from the wheel, so that an engaged part compares equal in the next step. */
    speed = state->wheel_speed_ms / metres_per_rad(config, state);
    state->crank_speed_rad_s = state->crank_engaged ? speed : crank_rad_s;
    state->motor_speed_rad_s = state->motor_engaged ? speed * ratio : motor_rad_s;
}

static void close_clutches(const physics_config *config, physics_state *state, instant *now)
{
    const double ratio = config->drivetrain.gear_ratio;
    double inertia = wheel_inertia_kg_m2(config, state, now->slipping);
    inertia += now->flow.crank_engaged ? config->drivetrain.crank_inertia_kg_m2 : 0.0;
    inertia += now->flow.motor_engaged ? config->motor.inertia_kg_m2 * ratio * ratio : 0.0;
    state->crank_engaged = now->flow.crank_engaged;
    state->motor_engaged = now->flow.motor_engaged;
    double speed = now->chainring.speed;
    close_grip(config, state, now, &inertia, &speed);
    drop_in(config, state, inertia, speed, now->crank.speed, now->motor_shaft.speed);
    state->speed_ms = state->slipping ? now->bike.speed : state->wheel_speed_ms;
}

/* The chain moves to another cog. A chainring that is faster then leaves cranks and rotor behind;
 * into one that is slower they drop: the wheel keeps its momentum, and the rest is heat. */
static void shift(const physics_config *config, physics_state *state, double dt_s)
{
    const double chainring_rad_s = state->wheel_speed_ms / metres_per_rad(config, state);
    gears_step(&config->gears, &state->gears, chainring_rad_s * RPM_PER_RAD_S, dt_s);
    const double ratio = config->drivetrain.chainring_teeth / physics_cog_teeth(config, state);
    if (ratio == state->chain_ratio) return;
    state->chain_ratio = ratio;
    state->crank_engaged = 0;
    state->motor_engaged = 0;
    drop_in(config, state, wheel_inertia_kg_m2(config, state, state->slipping),
            state->wheel_speed_ms / metres_per_rad(config, state), state->crank_speed_rad_s,
            state->motor_speed_rad_s);
    if (!state->slipping) state->speed_ms = state->wheel_speed_ms;
}

static void book(const physics_config *config, physics_state *state, const instant *now,
                 double dt_s)
{
    physics_ledger *ledger = &state->ledger;
    const drivetrain_config *drive = &config->drivetrain;
    const double chainring_rad = now->chainring.travel;
    const double travel_m = now->bike.travel;
    const double gear_out_nm = drivetrain_gear_share(drive) * now->flow.motor_nm;
    const double chain_in_nm = now->flow.crank_nm + gear_out_nm;
    const int driven = now->flow.crank_engaged || now->flow.motor_engaged;
    ledger->rider_work_j += now->rider_nm * now->crank.travel;
    ledger->legs_j += now->leg_drag_nm * now->crank.travel;
    ledger->motor_electric_j += (now->electric_w + now->switching_w + now->standby_w) * dt_s;
    ledger->switching_j += now->switching_w * dt_s;
    ledger->standby_j += now->standby_w * dt_s;
    ledger->copper_j += now->motor.copper_loss_w * dt_s;
    ledger->motor_friction_j += now->motor.friction_torque_nm * now->motor_shaft.travel;
    ledger->gear_j += (now->flow.motor_nm - gear_out_nm) * chainring_rad +
                      now->gear_drag_nm * now->motor_shaft.travel;
    /* What the printed equation makes out of nothing is no negative loss: it stays unexplained. */
    const double chain_share = drive->literal_4_14 ? 1.0 : drive->chain_efficiency;
    ledger->chain_j += (1.0 - chain_share) * chain_in_nm * chainring_rad;
    ledger->chain_j += driven ? drive->chain_drag_nm * chainring_rad : 0.0;
    ledger->potential_j += now->road.grade_n * travel_m;
    ledger->air_j += now->road.air_n * travel_m;
    ledger->rolling_j += now->road.rolling_n * travel_m;
    ledger->brake_j += now->road.brake_n * travel_m;
    ledger->dyno_j += now->road.dyno_n * travel_m;
    if (now->slipping) {
        ledger->slip_j += now->grip_n * (chainring_rad * metres_per_rad(config, state) - travel_m);
    }
}

/* What the drive has taken in this step, out of the battery. */
static void supply(const physics_config *config, physics_state *state,
                   const physics_command *command, double dt_s, instant *now)
{
    const double beside_a = now->motor.beside_a;
    now->electric_w = now->motor.electromagnetic_torque_nm * now->motor_shaft.travel / dt_s +
                      now->motor.copper_loss_w + now->motor.magnetic_w;
    const battery_load load = {now->electric_w, beside_a};
    battery_step(&config->battery, &state->battery, load, command->faults.battery_cut, dt_s);
    now->standby_w = state->battery.voltage_v * config->motor.standby_current_a;
    now->switching_w = state->battery.voltage_v * (beside_a - config->motor.standby_current_a);
}

static void warm(const physics_config *config, physics_state *state, const instant *now,
                 double dt_s)
{
    const double motor_rad_s = now->motor_shaft.travel / dt_s;
    const double friction_w = now->motor.friction_torque_nm * motor_rad_s;
    motor_heat_step(&config->motor, &state->heat, now->motor.copper_loss_w, friction_w,
                    now->switching_w, dt_s);
    rider_tire(&config->rider, &state->rider, now->rider_nm * now->crank.travel / dt_s, dt_s);
}

/* What the sensors make of it: pulses of the wheel, and every 2 ms a word from the spindle. */
static void sense(const physics_config *config, physics_state *state,
                  const physics_command *command, double dt_s)
{
    switch (command->faults.speed_sensor) {
    case SPEED_SENSOR_LOST:
        state->seen_speed_ms = 0.0;
        state->seen_speed_age_s += dt_s;
        break;
    case SPEED_SENSOR_STUCK: break;
    default:
        state->seen_speed_ms = state->wheel_speed_ms;
        state->seen_speed_age_s = 0.0;
        break;
    }
    wheel_sensor_step(&config->wheel, &state->wheel,
                      state->seen_speed_ms * dt_s / (2.0 * PI * config->road.wheel_radius_m),
                      command->faults.pulses_missed, dt_s);
    state->steps++;
    state->link.arrived = 0;
    if (state->steps % ROTOR_LINK_PERIOD_MS != 0) {
        return;
    }
    const int16_t counts = torque_sensor_read(
        &config->sensor, &state->sensor, state->spindle_torque_nm, state->crank_angle_rad,
        command->faults.torque_sensor, ROTOR_LINK_PERIOD_MS * dt_s);
    rotor_link_exchange(&config->link, &state->link, counts,
                        torque_sensor_temperature_degc(&state->sensor),
                        state->crank_angle_rad * DEG_PER_RAD, command->faults.link_lost);
}

void physics_step(const physics_config *config, physics_state *state,
                  const physics_command *command, double dt_s)
{
    instant now = {0};
    shift(config, state, dt_s);
    gather(config, state, command, dt_s, &now);
    move(config, state, dt_s, &now);
    close_clutches(config, state, &now);
    supply(config, state, command, dt_s, &now);
    book(config, state, &now, dt_s);

    const double travel_m = now.bike.travel;
    state->t_s += dt_s;
    state->hung_s += dt_s;
    state->distance_m += travel_m;
    state->height_m += travel_m * sin(command->road.grade_deg * PI / 180.0);
    state->crank_angle_rad = fmod(state->crank_angle_rad + now.crank.travel, 2.0 * PI);
    state->crank_angle_rad += state->crank_angle_rad < 0.0 ? 2.0 * PI : 0.0;
    state->spindle_torque_nm = now.flow.crank_nm;
    state->motor_shaft_nm = fmax(now.motor.shaft_torque_nm, 0.0);
    state->motor_current_a = now.motor.current_a;
    warm(config, state, &now, dt_s);
    sense(config, state, command, dt_s);
}

static double stored_j(const physics_config *config, const physics_state *state)
{
    const double rear_kg = road_rear_wheel_mass_kg(&config->road);
    const double outer_kg = road_moving_mass_kg(&config->road) - rear_kg;
    const double crank_inertia = config->drivetrain.crank_inertia_kg_m2;
    const rotor_values current_a = state->foc.current_a;
    const double field_j =
        0.75 * config->motor.inductance_h * (current_a.d * current_a.d + current_a.q * current_a.q);
    return 0.5 * outer_kg * state->speed_ms * state->speed_ms +
           0.5 * rear_kg * state->wheel_speed_ms * state->wheel_speed_ms +
           0.5 * crank_inertia * state->crank_speed_rad_s * state->crank_speed_rad_s +
           0.5 * config->motor.inertia_kg_m2 * state->motor_speed_rad_s * state->motor_speed_rad_s +
           field_j;
}

void physics_hang(const physics_config *config, physics_state *state, const hung_mass *hung)
{
    state->speed_ms = 0.0;
    state->wheel_speed_ms = 0.0;
    state->crank_speed_rad_s = 0.0;
    state->motor_speed_rad_s = 0.0;
    state->slipping = 0;
    state->crank_angle_rad = hung_mass_crank_rad(hung);
    state->hung_s = 0.0;
    physics_begin_ledger(config, state);
}

void physics_begin_ledger(const physics_config *config, physics_state *state)
{
    const physics_ledger empty = {0};
    state->ledger = empty;
    state->ledger.stored_start_j = stored_j(config, state);
}

double physics_energy_balance_error_pct(const physics_config *config, const physics_state *state)
{
    return ledger_balance_error_pct(&state->ledger, stored_j(config, state));
}

int physics_is_energy_consistent(const physics_config *config)
{
    const int printed_dyno =
        config->road.source == LOAD_DYNO && config->road.dyno_convention == DYNO_THESIS;
    return !config->drivetrain.literal_4_14 && !printed_dyno;
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
    state->wheel_speed_ms = state->speed_ms;
    state->seen_speed_ms = state->speed_ms;
    wheel_sensor_reset(&state->wheel, seed ^ WHEEL_STREAM);
    physics_renew(config, state);
    state->chain_ratio = config->drivetrain.chainring_teeth / physics_cog_teeth(config, state);
    state->crank_speed_rad_s = state->speed_ms / metres_per_rad(config, state);
    state->motor_speed_rad_s = state->crank_speed_rad_s * config->drivetrain.gear_ratio;
    rotor_link_reset(&state->link, torque_sensor_temperature_degc(&state->sensor));
    physics_seed(state, seed);
    physics_begin_ledger(config, state);
}

void physics_renew(const physics_config *config, physics_state *state)
{
    const uint64_t noise = state->sensor.random;
    const double own_rpm =
        physics_kinematics_at(config, state->wheel_speed_ms * KMH_PER_MS).crank_rpm;
    gears_reset(&config->gears, &state->gears, own_rpm, config->drivetrain.cog_teeth);
    motor_heat_reset(&config->motor, &state->heat);
    battery_reset(&config->battery, &state->battery);
    rider_reset(&config->rider, &state->rider);
    torque_sensor_reset(&config->sensor, &state->sensor);
    state->sensor.random = noise;
}

void physics_seed(physics_state *state, uint64_t seed)
{
    state->rider.random = seed ^ LEGS_STREAM;
    state->sensor.random = seed;
    state->wheel.noise = seed ^ WHEEL_STREAM;
    rotor_link_seed(&state->link, seed ^ LINK_STREAM);
}

#include "road.h"

#include <math.h>

#define RAD_PER_DEG (3.14159265358979323846 / 180.0)

/* No crank moves a wheel in a clamp; finite, because no way times it has to be no work. */
#define CLAMP_N 1e6

/* Most that tyres under this share of the weight push or hold with; infinite where none slips. */
static double tyres_n(const road_config *config, const road_command *command, double share)
{
    if (config->source == LOAD_DYNO || !(config->grip > 0.0)) {
        return HUGE_VAL;
    }
    const double pressed_n =
        share * config->mass_kg * config->gravity_m_s2 * cos(command->grade_deg * RAD_PER_DEG);
    return config->grip * pressed_n;
}

/* The dynamometer only brakes: a slope downwards is no load (thesis_checks 4.6). */
static double dyno_force_n(const road_config *config, const road_command *command,
                           double chain_ratio, double chain_efficiency)
{
    const double lift_n =
        config->mass_kg * config->gravity_m_s2 * sin(command->grade_deg * RAD_PER_DEG);
    const double force_n = command->dyno_nm / config->dyno_roller_radius_m + fmax(lift_n, 0.0);
    if (config->dyno_convention == DYNO_PHYSICAL) {
        return force_n;
    }
    /* The printed relation puts dyno / ratio on the cranks; this is the tyre force that does. */
    const double crank_nm = force_n * config->dyno_roller_radius_m / chain_ratio;
    return crank_nm * chain_efficiency / (chain_ratio * config->wheel_radius_m);
}

road_forces road_forces_at(const road_config *config, const road_command *command, double speed_ms,
                           double chain_ratio, double chain_efficiency)
{
    road_forces forces = {0};
    const double weight_n = config->mass_kg * config->gravity_m_s2;
    if (command->brake) {
        forces.brake_n = fmin(config->brake_force_n, tyres_n(config, command, 1.0));
    }
    if (command->held) forces.brake_n = CLAMP_N;
    if (config->source == LOAD_DYNO) {
        forces.dyno_n = dyno_force_n(config, command, chain_ratio, chain_efficiency);
        forces.rolling_n = config->roller_coefficient * weight_n;
        return forces;
    }
    const double grade_rad = command->grade_deg * RAD_PER_DEG;
    const double air_ms = speed_ms + command->wind_ms;
    forces.grade_n = weight_n * sin(grade_rad);
    forces.rolling_n = config->rolling_coefficient * weight_n * cos(grade_rad);
    forces.air_n = 0.5 * config->air_density_kg_m3 * config->drag_area_m2 * air_ms * fabs(air_ms);
    return forces;
}

/* What turns has a mass, or a bench without flywheel, and a slipping wheel without inertia, would
 * be at any speed in no time. */
#define REAR_WHEEL_KG_MIN 0.1
#define BENCH_KG_MIN 1.0

double road_moving_mass_kg(const road_config *config)
{
    const double wheels_kg =
        config->wheel_inertia_kg_m2 / (config->wheel_radius_m * config->wheel_radius_m);
    if (config->source != LOAD_DYNO) {
        return config->mass_kg + wheels_kg;
    }
    const double roller_squared = config->dyno_roller_radius_m * config->dyno_roller_radius_m;
    return fmax(config->dyno_mass_kg + wheels_kg +
                    (config->flywheel_kg_m2 + config->rollers_kg_m2) / roller_squared,
                BENCH_KG_MIN);
}

double road_rear_wheel_mass_kg(const road_config *config)
{
    const double radius_squared = config->wheel_radius_m * config->wheel_radius_m;
    return fmax(0.5 * config->wheel_inertia_kg_m2 / radius_squared, REAR_WHEEL_KG_MIN);
}

double road_grip_n(const road_config *config, const road_command *command)
{
    return tyres_n(config, command, config->rear_wheel_share);
}

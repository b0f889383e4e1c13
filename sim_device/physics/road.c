#include "road.h"

#include <math.h>

#define RAD_PER_DEG (3.14159265358979323846 / 180.0)

static double dyno_force_n(const road_config *config, const road_command *command,
                           double chain_ratio, double chain_efficiency)
{
    const double force_n = command->dyno_nm / config->dyno_roller_radius_m;
    if (config->dyno_convention == DYNO_PHYSICAL) {
        return force_n;
    }
    /* The printed relation puts dyno / ratio on the cranks; this is the tyre force that does. */
    const double crank_nm = command->dyno_nm / chain_ratio;
    return crank_nm * chain_efficiency / (chain_ratio * config->wheel_radius_m);
}

road_forces road_forces_at(const road_config *config, const road_command *command, double speed_ms,
                           double chain_ratio, double chain_efficiency)
{
    road_forces forces = {0};
    forces.brake_n = command->brake ? config->brake_force_n : 0.0;
    if (config->source == LOAD_DYNO) {
        forces.dyno_n = dyno_force_n(config, command, chain_ratio, chain_efficiency);
        return forces;
    }
    const double weight_n = config->mass_kg * config->gravity_m_s2;
    const double grade_rad = command->grade_deg * RAD_PER_DEG;
    const double air_ms = speed_ms + command->wind_ms;
    forces.grade_n = weight_n * sin(grade_rad);
    forces.rolling_n = config->rolling_coefficient * weight_n * cos(grade_rad);
    forces.air_n = 0.5 * config->air_density_kg_m3 * config->drag_area_m2 * air_ms * fabs(air_ms);
    return forces;
}

double road_moving_mass_kg(const road_config *config)
{
    const double mass_kg = config->source == LOAD_DYNO ? config->dyno_mass_kg : config->mass_kg;
    return mass_kg +
           config->wheel_inertia_kg_m2 / (config->wheel_radius_m * config->wheel_radius_m);
}

#include "hung_mass.h"

#include <math.h>

#define PI 3.14159265358979323846

/* Discs on a hook: a swing takes a second, and the hook's friction ends it within some ten. */
#define HOOK_M 0.25
#define SWING_S 3.0

double hung_mass_crank_rad(const hung_mass *hung)
{
    const double level_rad = hung->side == PEDAL_LEFT ? 0.5 * PI : 1.5 * PI;
    return level_rad + hung->crank_angle_rad;
}

hung_load hung_mass_load(const hung_mass *hung, double gravity_m_s2, double lever_m, double age_s)
{
    const double rad_s = sqrt(gravity_m_s2 / HOOK_M);
    const double phase_rad = rad_s * age_s + hung->swing_phase_rad;
    const double left_rad = hung->swing_rad * exp(-age_s / SWING_S);
    const double forward_rad = left_rad * cos(phase_rad);
    const double turning_rad_s = -left_rad * (rad_s * sin(phase_rad) + cos(phase_rad) / SWING_S);
    const double pull_n =
        hung->mass_kg * (gravity_m_s2 * cos(forward_rad) + HOOK_M * turning_rad_s * turning_rad_s);
    /* The pull's share along the pedal's way, which goes down and then backwards. */
    const hung_load load = {
        .torque_nm = pull_n * hung->arm_m * cos(hung->crank_angle_rad + forward_rad),
        .bending_nm = pull_n * lever_m,
    };
    return load;
}

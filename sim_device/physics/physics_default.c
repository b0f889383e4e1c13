#include "physics.h"

/* W1: thesis_checks 4.7. Motor: I-5. Battery and heat: 6, of the size usual for such a unit. */
void physics_default(physics_config *config)
{
    const physics_config bike = {
        .road =
            {
                .source = LOAD_ROAD,
                .mass_kg = 100.0,
                .wheel_inertia_kg_m2 = 0.24,
                .wheel_radius_m = 0.33,
                .rolling_coefficient = 0.00864,
                .drag_area_m2 = 0.40,
                .air_density_kg_m3 = 1.2,
                .gravity_m_s2 = 9.80665,
                .brake_force_n = 250.0,
                .dyno_convention = DYNO_PHYSICAL,
                .dyno_roller_radius_m = 0.33,
                .dyno_mass_kg = 33.3,
            },
        .drivetrain =
            {
                .gear_ratio = 40.34,
                .chainring_teeth = 44.0,
                .cog_teeth = 14.0,
                .gear_efficiency = 0.92,
                .chain_efficiency = 0.97,
                .crank_inertia_kg_m2 = 0.02,
            },
        .motor =
            {
                .torque_constant_nm_per_a = 0.112,
                .resistance_ohm = 0.25,
                .friction_nm_s = 1.2e-4,
                .inertia_kg_m2 = 1.4e-4,
                .torque_nm_max = 2.0,
                .speed_rpm_max = 3000.0,
                .bus_current_a_max = 12.0,
                .bus_power_w_max = 432.0,
                .heat_capacity_j_per_k = 780.0,
                .heat_resistance_k_per_w = 1.8,
                .ambient_degc = 20.0,
            },
        .battery = {.capacity_ah = 10.0, .resistance_ohm = 0.12, .soc_pct_start = 90.0},
        .rider = {.stroke_ripple = 0.8, .still_leg_drag_nm = 3.0},
        .sensor = {.nm_per_count = 0.01, .gain = 1.0, .temperature_degc = 20.0},
    };
    *config = bike;
}

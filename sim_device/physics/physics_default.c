#include "physics.h"

/* W1: thesis_checks 4.7. Motor: I-5. Battery, heat, spindle, drift and link: 6 and I-21. What W1
 * does not have (drags, grip, tiring legs, noise) is 0 and switched on by a scenario. */
static const road_config ROAD = {
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
    .flywheel_kg_m2 = 3.3,
    .rollers_kg_m2 = 0.32637, /* 33.3 kg at the tyre with the flywheel */
    .rear_wheel_share = 0.6,
};

static const drivetrain_config DRIVETRAIN = {
    .gear_ratio = 40.34,
    .chainring_teeth = 44.0,
    .cog_teeth = 14.0,
    .gear_efficiency = 0.92,
    .chain_efficiency = 0.97,
    .crank_inertia_kg_m2 = 0.02,
};

/* Without a cassette. A rider of one shifts to 65 a minute: at 74 this motor turns its fastest. */
static const gears_config GEARS = {
    .cadence_rpm = 65.0,
    .hysteresis_rpm = 8.0,
    .shift_s = 0.4,
    .shift_torque_share = 0.3,
};

static const motor_config MOTOR = {
    .torque_constant_nm_per_a = 0.112,
    .resistance_ohm = 0.25,
    .friction_nm_s = 1.2e-4,
    .inertia_kg_m2 = 1.4e-4,
    .torque_nm_max = 2.0,
    .speed_rpm_max = 3000.0,
    .winding_share = 0.8,
    .resistance_share_per_k = 0.00393,
    .inductance_h = 1.5e-4,
    .pole_pairs = 4.0,
    .current_bandwidth_hz = 500.0,
    .winding_heat_j_per_k = 80.0,
    .housing_heat_j_per_k = 700.0,
    .winding_k_per_w = 1.2,
    .housing_k_per_w = 1.8,
    .bridge_heat_j_per_k = 40.0,
    .bridge_k_per_w = 3.0,
    .ambient_degc = 20.0,
};

static const battery_config BATTERY = {
    .capacity_ah = 10.0,
    .resistance_ohm = 0.12,
    .polarisation_ohm = 0.05,
    .polarisation_s = 40.0,
    .resistance_share_per_k_cold = 0.03,
    .soc_pct_start = 90.0,
    .temperature_degc = 20.0,
    .cut_voltage_v_min = 28.0,
    .cut_current_a_max = 25.0,
    .cut_after_s = 0.5,
};

static const rider_config RIDER = {
    .stroke_ripple = 0.8,
    .still_leg_drag_nm = 3.0,
    .cadence_rpm_empty = 200.0,
    .reserve_j = 15000.0,
    .peak_power_w = 900.0,
};

static const torque_sensor_config SENSOR = {
    .shaft_diameter_m = 0.020,
    .bore_diameter_m = 0.012,
    .elastic_modulus_pa = 206e9,
    .poisson_ratio = 0.29,
    .gauge_factor = 2.0,
    .bridge_v = 3.3,
    .amplifier_gain = 426.0, /* 1.3 V for the 100 Nm of the thesis */
    .zero_v = 0.2,
    .converter_v = 3.3,
    .adc_bits = 16.0,
    .nm_per_count = 0.01,
    .gain = 1.0,
    .bending_lever_m = 0.10, /* half a Q factor of 170 mm, half a pedal, less half a shell */
    .bending_deg = 45.0,
    .creep_s = 60.0,
    .ambient_degc = 20.0,
    .board_soak_s = 20.0,
    .gauge_soak_s = 180.0,
    .reference_degc = 20.0,
    .zero_nm_per_k = 0.02,
    .span_share_per_k = 2e-4,
    .fault_drift_nm_per_min = 4.0,
};

static const rotor_link_config LINK = {
    .burst_bit_error_rate = 0.5,
    .burst_words = 4.0,
    .burst_angle_deg = 90.0,
    .coupling = 1.0,
    .coupling_min = 0.3,
    .restart_s = 0.02,
};

/* A ring as for antilock brakes, beside the disc. */
static const wheel_sensor_config WHEEL = {
    .pulses_per_turn = 36.0,
};

void physics_default(physics_config *config)
{
    config->road = ROAD;
    config->drivetrain = DRIVETRAIN;
    config->gears = GEARS;
    config->motor = MOTOR;
    config->battery = BATTERY;
    config->rider = RIDER;
    config->sensor = SENSOR;
    config->link = LINK;
    config->wheel = WHEEL;
}

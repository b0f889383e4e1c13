#include "motor.h"

#include <math.h>

#define RAD_S_PER_RPM (3.14159265358979323846 / 30.0)

/* Largest electromagnetic torque whose electrical power, T*omega + (T/K)^2 R, is `power_w`. */
static double torque_at_power(const motor_config *config, double power_w, double speed_rad_s)
{
    const double k_squared = config->torque_constant_nm_per_a * config->torque_constant_nm_per_a;
    const double root =
        sqrt(speed_rad_s * speed_rad_s + 4.0 * config->resistance_ohm * power_w / k_squared);
    return k_squared * (root - speed_rad_s) / (2.0 * config->resistance_ohm);
}

static double torque_limit(const motor_config *config, double speed_rad_s, double voltage_v)
{
    if (speed_rad_s >= config->speed_rpm_max * RAD_S_PER_RPM) {
        return 0.0;
    }
    const double back_emf_v = config->torque_constant_nm_per_a * speed_rad_s;
    const double by_voltage =
        config->torque_constant_nm_per_a * (voltage_v - back_emf_v) / config->resistance_ohm;
    const double power_w = fmin(config->bus_power_w_max, config->bus_current_a_max * voltage_v);
    return fmax(fmin(by_voltage, torque_at_power(config, power_w, speed_rad_s)), 0.0);
}

motor_drive motor_drive_at(const motor_config *config, double demand_nm, double speed_rad_s,
                           double voltage_v)
{
    motor_drive drive = {0};
    drive.friction_torque_nm = config->friction_nm_s * speed_rad_s;
    if (demand_nm > 0.0) {
        const double wanted = fmin(demand_nm, config->torque_nm_max) + drive.friction_torque_nm;
        drive.electromagnetic_torque_nm =
            fmin(wanted, torque_limit(config, speed_rad_s, voltage_v));
    }
    drive.shaft_torque_nm = drive.electromagnetic_torque_nm - drive.friction_torque_nm;
    drive.current_a = drive.electromagnetic_torque_nm / config->torque_constant_nm_per_a;
    drive.copper_loss_w = drive.current_a * drive.current_a * config->resistance_ohm;
    return drive;
}

double motor_temperature_after(const motor_config *config, double temperature_degc, double heat_w,
                               double dt_s)
{
    const double away_w =
        (temperature_degc - config->ambient_degc) / config->heat_resistance_k_per_w;
    return temperature_degc + dt_s * (heat_w - away_w) / config->heat_capacity_j_per_k;
}

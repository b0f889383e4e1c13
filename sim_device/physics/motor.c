#include "motor.h"

#include <math.h>

#define RAD_S_PER_RPM (3.14159265358979323846 / 30.0)
#define REFERENCE_DEGC 20.0
#define STILL_RAD_S 1e-9
#define FADE_SHARE_PER_RAD_S (1.0 / (100.0 * RAD_S_PER_RPM))

double motor_resistance_ohm(const motor_config *config, double winding_degc)
{
    const double warmer_k = winding_degc - REFERENCE_DEGC;
    const double winding = config->winding_share * config->resistance_share_per_k * warmer_k;
    return config->resistance_ohm * (1.0 + winding);
}

static double friction_nm(const motor_config *config, double speed_rad_s)
{
    return config->friction_nm_s * speed_rad_s +
           (speed_rad_s > STILL_RAD_S ? config->hysteresis_nm : 0.0);
}

double motor_torque_limit_nm(const motor_config *config, motor_rotor rotor, battery_source source,
                             double winding_degc)
{
    const double k = config->torque_constant_nm_per_a;
    const double ohm = motor_resistance_ohm(config, winding_degc) +
                       (1.0 + config->switching_share) * source.resistance_ohm;
    const double open_v = source.open_v - config->standby_current_a * source.resistance_ohm;
    const double gain = rotor.gain_rad_s_per_nm;
    /* At the step's end w is this plus the gain times the torque. */
    const double slowed_rad_s = rotor.speed_rad_s - gain * friction_nm(config, rotor.speed_rad_s);
    const double by_voltage = k * (open_v - k * slowed_rad_s) / (ohm + k * k * gain);
    const double steepness_nm_s = config->torque_nm_max * FADE_SHARE_PER_RAD_S;
    const double spare_rad_s = config->speed_rpm_max * RAD_S_PER_RPM - slowed_rad_s;
    const double by_speed = steepness_nm_s * spare_rad_s / (1.0 + steepness_nm_s * gain);
    return fmax(fmin(by_voltage, by_speed), 0.0);
}

motor_drive motor_drive_at(const motor_config *config, double demand_nm, motor_rotor rotor,
                           battery_source source, double winding_degc)
{
    motor_drive drive = {0};
    drive.friction_torque_nm = friction_nm(config, rotor.speed_rad_s);
    if (demand_nm > 0.0) {
        const double wanted = fmin(demand_nm, config->torque_nm_max) + drive.friction_torque_nm;
        drive.electromagnetic_torque_nm =
            fmin(wanted, motor_torque_limit_nm(config, rotor, source, winding_degc));
    }
    drive.shaft_torque_nm = drive.electromagnetic_torque_nm - drive.friction_torque_nm;
    drive.current_a = drive.electromagnetic_torque_nm / config->torque_constant_nm_per_a;
    drive.copper_loss_w =
        drive.current_a * drive.current_a * motor_resistance_ohm(config, winding_degc);
    drive.beside_a = config->switching_share * drive.current_a + config->standby_current_a;
    return drive;
}

void motor_heat_reset(const motor_config *config, motor_heat *heat)
{
    heat->winding_degc = config->ambient_degc;
    heat->housing_degc = config->ambient_degc;
    heat->bridge_degc = config->ambient_degc;
}

void motor_heat_step(const motor_config *config, motor_heat *heat, double copper_w,
                     double friction_w, double switching_w, double dt_s)
{
    const double bridge_w = (1.0 - config->winding_share) * copper_w;
    const double inward_w = (heat->winding_degc - heat->housing_degc) / config->winding_k_per_w;
    const double outward_w = (heat->housing_degc - config->ambient_degc) / config->housing_k_per_w;
    const double bridge_out_w = (heat->bridge_degc - config->ambient_degc) / config->bridge_k_per_w;
    heat->winding_degc += dt_s * (copper_w - bridge_w - inward_w) / config->winding_heat_j_per_k;
    heat->housing_degc += dt_s * (inward_w + friction_w - outward_w) / config->housing_heat_j_per_k;
    heat->bridge_degc +=
        dt_s * (bridge_w + switching_w - bridge_out_w) / config->bridge_heat_j_per_k;
}

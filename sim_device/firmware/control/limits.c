/* What the motor and the battery can give, through the motor's own equations.
 *
 * Steady state of thesis eq. 4.8 and 4.9: U = i R + K w, T = i K, so the battery gives
 * P = i (i R + K w). Motor and battery limits hold at the same time (thesis_checks I-4, I-5). */
#include "assist_steps.h" // apply_limits, held_at
#include "float32.h"      // float32_clamp, float32_max, float32_min, float32_sqrt
#include "heat.h"         // HEAT_MOTOR_WARM_DEGC

static const float RAD_PER_S_PER_RPM = 0.104719755f;

/* A worn pack sags by about 3 V at its largest current (0.25 ohm at 12 A). Taking the current back
 * over as much above the lowest voltage keeps the loop's gain below one: assist fades. */
static const float SAG_BAND_V = 3.0f;

/* 1 where it is cool or not measured, 0 at the hot end. */
static float cool_share(float temperature_degc, float warm_degc, float hot_degc)
{
    if (!(temperature_degc > warm_degc)) return 1.0f;
    return float32_max((hot_degc - temperature_degc) / (hot_degc - warm_degc), 0.0f);
}

static float heat_torque_nm(const assist_config *config, const assist_input *input)
{
    float motor =
        cool_share(input->motor_temperature_degc, HEAT_MOTOR_WARM_DEGC, HEAT_MOTOR_HOT_DEGC);
    float controller = cool_share(input->controller_temperature_degc, HEAT_CONTROLLER_WARM_DEGC,
                                  HEAT_CONTROLLER_HOT_DEGC);

    return config->motor_torque_nm_max * float32_min(motor, controller);
}

/* Torque at which the bridge runs out of voltage; none at and above the highest speed. */
static float back_emf_torque_nm(const assist_config *config, const assist_input *input,
                                float back_emf_v)
{
    float headroom_v = input->battery_voltage_v - back_emf_v;

    if (input->motor_speed_rpm >= config->motor_speed_rpm_max || headroom_v <= 0.0f) return 0.0f;
    return config->motor_torque_constant_nm_per_a * headroom_v / config->motor_resistance_ohm;
}

/* Torque at which the battery gives its largest current: the positive root of
 * R i^2 + K w i = P, in the form that does not subtract two near numbers. */
static float battery_torque_nm(const assist_config *config, const assist_input *input,
                               float back_emf_v, float sag_share)
{
    float power_w =
        float32_max(input->battery_voltage_v, 0.0f) * (config->battery_current_a_max * sag_share);
    float root_v =
        float32_sqrt(back_emf_v * back_emf_v + 4.0f * config->motor_resistance_ohm * power_w);
    float sum_v = back_emf_v + root_v;

    if (sum_v <= 0.0f) return 0.0f;
    return config->motor_torque_constant_nm_per_a * (2.0f * power_w / sum_v);
}

float apply_limits(const assist_config *config, const assist_input *input, float demand_nm,
                   assist_output *output)
{
    float speed_rad_s = float32_max(input->motor_speed_rpm, 0.0f) * RAD_PER_S_PER_RPM;
    float back_emf_v = config->motor_torque_constant_nm_per_a * speed_rad_s;
    float above_v = input->battery_voltage_v - config->battery_voltage_v_min;
    float sag_share = float32_clamp(above_v / SAG_BAND_V, 0.0f, 1.0f);
    unsigned battery_flag =
        sag_share < 1.0f ? ASSIST_LIMIT_BATTERY_VOLTAGE : ASSIST_LIMIT_BATTERY_CURRENT;
    float motor_nm = demand_nm / config->gear_ratio;

    motor_nm = held_at(config->motor_torque_nm_max * config->mode_torque_share[input->mode],
                       motor_nm, ASSIST_LIMIT_MOTOR_TORQUE, output);
    motor_nm = held_at(heat_torque_nm(config, input), motor_nm, ASSIST_LIMIT_TEMPERATURE, output);
    motor_nm = held_at(battery_torque_nm(config, input, back_emf_v, sag_share), motor_nm,
                       battery_flag, output);
    motor_nm = held_at(back_emf_torque_nm(config, input, back_emf_v), motor_nm,
                       ASSIST_LIMIT_MOTOR_SPEED, output);
    return float32_max(motor_nm, 0.0f);
}

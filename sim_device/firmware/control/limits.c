/* What the motor and the battery can give, through the motor's own equations.
 *
 * Steady state of thesis eq. 4.8 and 4.9: U = i R + K w, T = i K, so the battery gives
 * P = i (i R + K w). Motor and battery limits hold at the same time (thesis_checks I-4, I-5). */
#include "assist_steps.h" // apply_limits, held_at
#include "float32.h"      // float32_max, float32_sqrt

static const float RAD_PER_S_PER_RPM = 0.104719755f;

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
                               float back_emf_v)
{
    float power_w = float32_max(input->battery_voltage_v, 0.0f) * config->battery_current_a_max;
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
    float motor_nm = demand_nm / config->gear_ratio;

    motor_nm = held_at(config->motor_torque_nm_max, motor_nm, ASSIST_LIMIT_MOTOR_TORQUE, output);
    motor_nm = held_at(battery_torque_nm(config, input, back_emf_v), motor_nm,
                       ASSIST_LIMIT_BATTERY_CURRENT, output);
    motor_nm = held_at(back_emf_torque_nm(config, input, back_emf_v), motor_nm,
                       ASSIST_LIMIT_MOTOR_SPEED, output);
    return float32_max(motor_nm, 0.0f);
}

/* What the motor, its heat and the battery can give: all limits hold at the same time
 * (thesis_checks I-4, I-5). The battery's own is in battery_power.c. */
#include "assist_steps.h" // apply_limits, held_at
#include "float32.h"      // float32_max, float32_min
#include "heat.h"         // HEAT_MOTOR_WARM_DEGC

static const float RAD_PER_S_PER_RPM = 0.104719755f;

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
                                float resistance_ohm, float back_emf_v)
{
    float headroom_v = input->battery_voltage_v - back_emf_v;

    if (input->motor_speed_rpm >= config->motor_speed_rpm_max || headroom_v <= 0.0f) return 0.0f;
    return config->motor_torque_constant_nm_per_a * headroom_v / resistance_ohm;
}

float apply_limits(const assist_config *config, assist_state *state, const assist_input *input,
                   float demand_nm, assist_output *output)
{
    float resistance_ohm = winding_resistance_ohm(config, input);
    float speed_rad_s = float32_max(input->motor_speed_rpm, 0.0f) * RAD_PER_S_PER_RPM;
    float back_emf_v = config->motor_torque_constant_nm_per_a * speed_rad_s;
    unsigned battery_flag =
        battery_sags(config, input) ? ASSIST_LIMIT_BATTERY_VOLTAGE : ASSIST_LIMIT_BATTERY_CURRENT;
    float motor_nm = demand_nm / config->gear_ratio;

    motor_nm = held_at(config->motor_torque_nm_max * config->mode_torque_share[input->mode],
                       motor_nm, ASSIST_LIMIT_MOTOR_TORQUE, output);
    motor_nm = held_at(heat_torque_nm(config, input), motor_nm, ASSIST_LIMIT_TEMPERATURE, output);
    motor_nm = held_at(battery_torque_nm(config, state, input, resistance_ohm, back_emf_v),
                       motor_nm, battery_flag, output);
    motor_nm = held_at(back_emf_torque_nm(config, input, resistance_ohm, back_emf_v), motor_nm,
                       ASSIST_LIMIT_MOTOR_SPEED, output);
    return float32_max(motor_nm, 0.0f);
}

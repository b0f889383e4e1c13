/* What the motor, its heat and the battery can give: all limits hold at the same time
 * (thesis_checks I-4, I-5). The battery's own is in battery_power.c. And what the motor gave. */
#include "assist.h"       // motor_torque_delivered_nm
#include "assist_steps.h" // apply_limits, held_at
#include "float32.h"      // float32_abs, float32_max, float32_min
#include "heat.h"         // HEAT_MOTOR_WARM_DEGC

static const float RAD_PER_S_PER_RPM = 0.104719755f;

/* Over the last of its speed the motor's regulator takes the torque back. */
static const float SPEED_FADE_RPM = 100.0f;

/* Bearings, air and eddy currents of the motor (thesis_checks I-5). */
static const float DRAG_NM_S = 1.2e-4f;

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

/* To push, the motor must turn as fast as the crank; slower, it spins free in its clutch. */
static float pushing_speed_rpm(const assist_config *config, const assist_input *input)
{
    return float32_max(input->motor_speed_rpm, input->cadence_rpm * config->gear_ratio);
}

/* Torque at which the bridge runs out of voltage, or at which the motor's speed regulator holds:
 * none at and above the highest speed. */
static float back_emf_torque_nm(const assist_config *config, const assist_input *input,
                                float resistance_ohm)
{
    float speed_rpm = pushing_speed_rpm(config, input);
    float spare_rpm = config->motor_speed_rpm_max - speed_rpm;
    float back_emf_v = config->motor_torque_constant_nm_per_a * (speed_rpm * RAD_PER_S_PER_RPM);
    float headroom_v = input->battery_voltage_v - back_emf_v;
    float by_speed_nm = config->motor_torque_nm_max * (spare_rpm / SPEED_FADE_RPM);
    float by_voltage_nm = config->motor_torque_constant_nm_per_a * headroom_v / resistance_ohm;

    return float32_max(float32_min(by_voltage_nm, by_speed_nm), 0.0f);
}

/* Lowers what is available too, whatever is asked. */
static float held_available(float limit_nm, float motor_nm, unsigned flag, assist_output *output,
                            assist_trace *trace, unsigned step)
{
    trace_note(trace, step, limit_nm);
    output->motor_torque_available_nm = float32_min(output->motor_torque_available_nm, limit_nm);
    return held_at(limit_nm, motor_nm, flag, output);
}

float apply_limits(const assist_config *config, assist_state *state, const assist_input *input,
                   float demand_nm, assist_output *output, assist_trace *trace)
{
    float highest_nm = config->motor_torque_nm_max * config->mode_torque_share[input->mode];
    float resistance_ohm = winding_resistance_ohm(config, input);
    float speed_rad_s = float32_max(input->motor_speed_rpm, 0.0f) * RAD_PER_S_PER_RPM;
    float back_emf_v = config->motor_torque_constant_nm_per_a * speed_rad_s;
    unsigned battery_flag =
        battery_sags(config, input) ? ASSIST_LIMIT_BATTERY_VOLTAGE : ASSIST_LIMIT_BATTERY_CURRENT;
    float motor_nm = demand_nm / config->gear_ratio;

    trace_note(trace, ASSIST_TRACE_MOTOR, highest_nm);
    output->motor_torque_available_nm = highest_nm;
    motor_nm = held_at(highest_nm, motor_nm, ASSIST_LIMIT_MOTOR_TORQUE, output);
    motor_nm = held_available(heat_torque_nm(config, input), motor_nm, ASSIST_LIMIT_TEMPERATURE,
                              output, trace, ASSIST_TRACE_HEAT);
    motor_nm = held_available(battery_torque_nm(config, state, input, resistance_ohm, back_emf_v),
                              motor_nm, battery_flag, output, trace, ASSIST_TRACE_BATTERY);
    motor_nm = held_available(back_emf_torque_nm(config, input, resistance_ohm), motor_nm,
                              ASSIST_LIMIT_MOTOR_SPEED, output, trace, ASSIST_TRACE_BACK_EMF);
    return float32_max(motor_nm, 0.0f);
}

float motor_torque_delivered_nm(const assist_config *config, float motor_current_a,
                                float motor_speed_rpm)
{
    float electromagnetic_nm = config->motor_torque_constant_nm_per_a * motor_current_a;
    float drag_nm = DRAG_NM_S * float32_abs(motor_speed_rpm * RAD_PER_S_PER_RPM);

    return float32_max(electromagnetic_nm - drag_nm, 0.0f);
}

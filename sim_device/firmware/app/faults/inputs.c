#include "inputs.h"

#include <string.h>

#include "float32.h" // float32_missing

/* The converter's word has 16 bits: at its ends a broken bridge arm looks like a strong rider. */
#define TORQUE_RAW_COUNTS_MAX 32767.0f

void inputs_prepare(hal_inputs *inputs)
{
    memset(inputs, 0, sizeof *inputs);
    inputs->sensor_temperature_degc = float32_missing();
    inputs->motor_temperature_degc = float32_missing();
    inputs->controller_temperature_degc = float32_missing();
    inputs->battery_current_a = float32_missing();
    inputs->motor_current_a = float32_missing();
    inputs->mode_selected = HAL_MODE_NOT_SELECTED;
}

void inputs_take(const hal *board, hal_inputs *inputs)
{
    inputs_prepare(inputs);
    board->inputs_read(board->context, inputs);
}

int inputs_torque_is_plausible(float torque_raw_counts)
{
    return torque_raw_counts > -TORQUE_RAW_COUNTS_MAX && torque_raw_counts < TORQUE_RAW_COUNTS_MAX;
}

static float pulse_m(const ebl_config *config)
{
    return config->wheel_circumference_m / (float)config->wheel_pulses_per_turn;
}

void road_speed_init(road_speed *speed)
{
    wheel_speed_init(&speed->wheel);
    speed->is_not_measured = 0;
}

float road_speed_step(road_speed *speed, const ebl_config *config, const hal_inputs *inputs)
{
    speed->is_not_measured = inputs->speed_age_ms == HAL_SPEED_NOT_MEASURED;
    return wheel_speed_pulses(&speed->wheel, pulse_m(config), inputs->wheel_pulses,
                              inputs->wheel_pulse_us);
}

float road_speed_kmh(const road_speed *speed, const ebl_config *config, uint64_t now_us)
{
    if (speed->is_not_measured) return float32_missing();
    return wheel_speed_kmh(&speed->wheel, pulse_m(config), now_us);
}

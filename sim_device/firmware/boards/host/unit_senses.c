#include "unit_senses.h"

#define DEG_PER_RAD (180.0 / 3.14159265358979323846)
#define RPM_PER_RAD_S (30.0 / 3.14159265358979323846)
#define US_PER_S 1000000.0
#define MS_PER_S 1000.0
#define SPEED_AGE_MS_MAX 60000.0

void senses_rotor_exchange(const physics_state *state, rotor_receiver *receiver)
{
    if (!state->link.arrived) return;
    rotor_receiver_exchange(receiver, state->link.present, state->link.word);
}

static const electric_values NOTHING = {0};

void senses_meter_reset(electric_meter *meter, const physics_state *state)
{
    meter->sum = NOTHING;
    meter->conversions = 0;
    senses_meter_convert(meter, state);
    senses_meter_end_step(meter);
}

void senses_meter_convert(electric_meter *meter, const physics_state *state)
{
    meter->sum.battery_voltage_v += state->battery.voltage_v;
    meter->sum.battery_current_a += state->battery.current_a;
    meter->sum.motor_current_a += state->motor_current_a;
    meter->conversions++;
}

void senses_meter_end_step(electric_meter *meter)
{
    if (meter->conversions == 0) return;
    const double share = 1.0 / meter->conversions;
    meter->mean.battery_voltage_v = share * meter->sum.battery_voltage_v;
    meter->mean.battery_current_a = share * meter->sum.battery_current_a;
    meter->mean.motor_current_a = share * meter->sum.motor_current_a;
    meter->sum = NOTHING;
    meter->conversions = 0;
}

void senses_read(const physics_state *state, const physics_command *command,
                 const rotor_receiver *receiver, const electric_meter *meter, uint64_t now_us,
                 hal_inputs *inputs)
{
    const physics_faults *faults = &command->faults;
    const double speed_age_ms = state->seen_speed_age_s * MS_PER_S;
    inputs->torque_raw_counts = receiver->torque_raw_counts;
    inputs->torque_age_ms = receiver->age_ms;
    inputs->sensor_temperature_degc = (float)receiver->temperature_degc;
    inputs->wheel_pulses = state->wheel.pulses;
    inputs->wheel_pulse_us = now_us - (uint64_t)(state->wheel.pulse_age_s * US_PER_S + 0.5);
    inputs->speed_age_ms =
        (uint16_t)(speed_age_ms < SPEED_AGE_MS_MAX ? speed_age_ms : SPEED_AGE_MS_MAX);
    inputs->crank_angle_deg = (float)(state->crank_angle_rad * DEG_PER_RAD);
    inputs->cadence_rpm = (float)(state->crank_speed_rad_s * RPM_PER_RAD_S);
    inputs->motor_speed_rpm =
        faults->motor_hall ? 0.0f : (float)(state->motor_speed_rad_s * RPM_PER_RAD_S);
    inputs->motor_current_a = (float)meter->mean.motor_current_a;
    inputs->motor_temperature_degc = (float)(state->heat.winding_degc + faults->motor_warmer_k);
    inputs->controller_temperature_degc =
        (float)(state->heat.bridge_degc + faults->controller_warmer_k);
    inputs->battery_voltage_v = (float)meter->mean.battery_voltage_v;
    inputs->battery_current_a = (float)meter->mean.battery_current_a;
    inputs->battery_soc_pct = (float)state->battery.soc_pct;
    inputs->battery_cut = state->battery.cut ? 1 : 0;
    inputs->brake = command->road.brake ? 1 : 0;
}

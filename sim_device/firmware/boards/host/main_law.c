/* The law as a program of its own, without Python: an image and float32 records in, float32 out.
 *
 * Standard input: one image of the configuration, then one input record (14 floats) a step.
 * Standard output: one output record (9 floats) a step. Floats are in the machine's byte order.
 * Ends with 0 at the end of the input, 1 for a broken record, 2 for a configuration the law
 * refuses. A test compares it bit for bit with the law's other two doors. */
#include <stdio.h>

#include "assist.h"             // assist_step
#include "ebl_registry.h"       // EBL_IMAGE_LENGTH, ebl_config_unpack
#include "storage/config_law.h" // config_law_from

#define INPUT_FLOATS 14
#define OUTPUT_FLOATS 9

static assist_input input_of(const float *floats)
{
    assist_input input;

    input.torque_raw_counts = floats[0];
    input.speed_kmh = floats[1];
    input.cadence_rpm = floats[2];
    input.motor_speed_rpm = floats[3];
    input.battery_voltage_v = floats[4];
    input.battery_current_a = floats[5];
    input.motor_temperature_degc = floats[6];
    input.controller_temperature_degc = floats[7];
    input.sensor_temperature_degc = floats[8];
    input.torque_age_ms = (uint16_t)floats[9];
    input.mode = (uint8_t)floats[10];
    input.brake = (uint8_t)floats[11];
    input.walk_button = (uint8_t)floats[12];
    input.inhibit = (uint8_t)floats[13];
    return input;
}

static int write_output(const assist_output *output)
{
    float floats[OUTPUT_FLOATS];

    floats[0] = output->rider_torque_nm;
    floats[1] = output->rider_torque_filtered_nm;
    floats[2] = output->torque_rate;
    floats[3] = output->assist_ratio;
    floats[4] = output->fuzzy_gain;
    floats[5] = output->motor_torque_nm;
    floats[6] = output->motor_torque_demanded_nm;
    floats[7] = output->motor_torque_available_nm;
    floats[8] = (float)output->limit_flags; /* 15 bits: exact */
    return fwrite(floats, sizeof floats, 1, stdout) == 1;
}

int main(void)
{
    uint8_t image[EBL_IMAGE_LENGTH];
    ebl_config values;
    float input_floats[INPUT_FLOATS];
    assist_config config;
    assist_state state = {0};
    size_t bytes;

    if (fread(image, sizeof image, 1, stdin) != 1) return 1;
    ebl_config_unpack(&values, image);
    config_law_from(&values, &config);
    if (assist_config_check(&config)) return 2;
    while ((bytes = fread(input_floats, 1, sizeof input_floats, stdin)) == sizeof input_floats) {
        assist_input input = input_of(input_floats);
        assist_output output;

        (void)assist_step(&config, &state, &input, &output); /* a refused input is told in flags */
        if (!write_output(&output)) return 1;
    }
    return bytes == 0 ? 0 : 1;
}

/* The law as a program of its own, without Python: float32 records in, float32 records out.
 *
 * Standard input: one configuration record (142 floats, in the order of read_config), then one
 * input record (13 floats) a step. Standard output: one output record (7 floats) a step. All in the
 * machine's byte order. Ends with 0 at the end of the input, 1 for a broken record, 2 for a
 * configuration the law refuses. A test compares it bit for bit with the law's other two doors. */
#include "assist.h" // assist_step

#include <stdio.h>

#define CONFIG_FLOATS 142
#define INPUT_FLOATS 13
#define OUTPUT_FLOATS 7

typedef struct {
    const float *next;
} record;

static float take(record *from) { return *from->next++; }

static uint8_t take_byte(record *from) { return (uint8_t)take(from); }

static void take_many(record *from, float *values, unsigned count)
{
    unsigned index;

    for (index = 0; index < count; ++index) values[index] = take(from);
}

static void read_table(record *from, fuzzy_table *table)
{
    unsigned index;

    table->inference = take_byte(from);
    take_many(from, table->speed_points_kmh, FUZZY_SETS);
    take_many(from, table->torque_rate_points, FUZZY_SETS);
    take_many(from, table->gain_points, FUZZY_SETS);
    for (index = 0; index < FUZZY_SETS * FUZZY_SETS; ++index) {
        table->rules[index / FUZZY_SETS][index % FUZZY_SETS] = take_byte(from);
    }
}

static void read_later(record *from, assist_config *config)
{
    unsigned slot;

    for (slot = 0; slot < ASSIST_MODE_SLOTS; ++slot) config->mode_tapers[slot] = take_byte(from);
    for (slot = 0; slot < ASSIST_MODE_SLOTS; ++slot) config->mode_tables[slot] = take_byte(from);
    take_many(from, config->mode_ramp_up_nm_per_s, ASSIST_MODE_SLOTS);
    take_many(from, config->mode_ramp_down_nm_per_s, ASSIST_MODE_SLOTS);
    take_many(from, config->mode_torque_share, ASSIST_MODE_SLOTS);
    read_table(from, &config->second_table);
    config->walk_speed_kmh = take(from);
    config->market = take_byte(from);
    config->assist_cutoff_extra_kmh = take(from);
}

static void read_config(const float *floats, assist_config *config)
{
    record from = {floats};
    unsigned slot;

    config->step_s = take(&from);
    config->sensor_offset_counts = take(&from);
    config->sensor_gain_nm_per_count = take(&from);
    config->torque_filter_s = take(&from);
    config->torque_rate_interval_s = take(&from);
    config->torque_rate_floor_nm = take(&from);
    for (slot = 0; slot < ASSIST_MODE_SLOTS; ++slot) config->mode_laws[slot] = take_byte(&from);
    take_many(&from, config->mode_ratios, ASSIST_MODE_SLOTS);
    config->fixed_taper_start_kmh = take(&from);
    config->fixed_taper_end_kmh = take(&from);
    config->assist_ramp_up_nm_per_s = take(&from);
    config->assist_ramp_down_nm_per_s = take(&from);
    config->pedal_torque_nm_min = take(&from);
    read_table(&from, &config->table);
    config->fuzzy_falling_torque = take_byte(&from);
    config->assist_cutoff_kmh = take(&from);
    config->assist_cutoff_band_kmh = take(&from);
    config->motor_torque_nm_max = take(&from);
    config->battery_current_a_max = take(&from);
    config->battery_voltage_v_min = take(&from);
    config->motor_speed_rpm_max = take(&from);
    config->pedal_stop_s = take(&from);
    config->gear_ratio = take(&from);
    config->motor_torque_constant_nm_per_a = take(&from);
    config->motor_resistance_ohm = take(&from);
    read_later(&from, config);
}

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
    input.torque_age_ms = (uint16_t)floats[8];
    input.mode = (uint8_t)floats[9];
    input.brake = (uint8_t)floats[10];
    input.walk_button = (uint8_t)floats[11];
    input.inhibit = (uint8_t)floats[12];
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
    floats[6] = (float)output->limit_flags; /* 15 bits: exact */
    return fwrite(floats, sizeof floats, 1, stdout) == 1;
}

int main(void)
{
    float config_floats[CONFIG_FLOATS];
    float input_floats[INPUT_FLOATS];
    assist_config config;
    assist_state state = {0};
    size_t bytes;

    if (fread(config_floats, sizeof config_floats, 1, stdin) != 1) return 1;
    read_config(config_floats, &config);
    if (assist_config_check(&config)) return 2;
    while ((bytes = fread(input_floats, 1, sizeof input_floats, stdin)) == sizeof input_floats) {
        assist_input input = input_of(input_floats);
        assist_output output;

        (void)assist_step(&config, &state, &input, &output); /* a refused input is told in flags */
        if (!write_output(&output)) return 1;
    }
    return bytes == 0 ? 0 : 1;
}

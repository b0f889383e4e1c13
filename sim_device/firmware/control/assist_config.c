/* Is this a configuration a bike can have? The registry's ranges are narrower; these only make sure
 * that no step divides by zero, overflows or reads past an array. */
#include "assist.h"  // assist_config_check
#include "float32.h" // float32_abs
#include "market.h"  // MARKET_COUNT

static const float LARGEST = 1.0e6f;
static const float SMALLEST = 1.0e-6f;

/* Times the 200 K of sensor.c less than one: more push never reads as less. */
static const float GAIN_SHARE_PER_K_MAX = 0.0045f;

static int positive(float value) { return value >= SMALLEST && value <= LARGEST; }

static int not_negative(float value) { return value >= 0.0f && value <= LARGEST; }

/* NaN is none. */
static int none_or_within(float value, float limit) { return !(float32_abs(value) > limit); }

static int temperature_accepted(const assist_config *config)
{
    return none_or_within(config->sensor_offset_counts_per_k, LARGEST) &&
           none_or_within(config->sensor_gain_share_per_k, GAIN_SHARE_PER_K_MAX) &&
           none_or_within(config->sensor_reference_degc, LARGEST);
}

static int sensor_accepted(const assist_config *config)
{
    float interval_steps = config->torque_rate_interval_s / config->step_s;
    float pedal_stop_steps = config->pedal_stop_s / config->step_s;

    return config->sensor_offset_counts >= -LARGEST && config->sensor_offset_counts <= LARGEST &&
           positive(config->sensor_gain_nm_per_count) && not_negative(config->torque_filter_s) &&
           config->torque_filter <= ASSIST_FILTER_HALF_TURN &&
           positive(config->torque_rate_floor_nm) && interval_steps >= 0.5f &&
           interval_steps <= (float)ASSIST_RATE_HISTORY && pedal_stop_steps >= 0.0f &&
           pedal_stop_steps <= 65000.0f; /* counted in 16 bits */
}

static int law_accepted(const assist_config *config)
{
    unsigned slot;

    for (slot = 0; slot < ASSIST_MODE_SLOTS; ++slot) {
        if (config->mode_laws[slot] > ASSIST_LAW_FUZZY) return 0;
        if (config->mode_tapers[slot] > ASSIST_TAPER_JAPAN_2_TO_1) return 0;
        if (config->mode_tables[slot] > 1) return 0;
        if (!not_negative(config->mode_ratios[slot])) return 0;
        if (!positive(config->mode_ramp_up_nm_per_s[slot])) return 0;
        if (!positive(config->mode_ramp_down_nm_per_s[slot])) return 0;
        if (!(config->mode_torque_share[slot] >= 0.0f)) return 0;
        if (config->mode_torque_share[slot] > 1.0f) return 0;
    }
    return not_negative(config->fixed_taper_start_kmh) &&
           not_negative(config->fixed_taper_end_kmh) &&
           config->fixed_taper_end_kmh >= config->fixed_taper_start_kmh &&
           positive(config->assist_ramp_up_nm_per_s) &&
           positive(config->assist_ramp_down_nm_per_s) &&
           not_negative(config->pedal_torque_nm_min) && config->fuzzy_falling_torque <= 1 &&
           fuzzy_table_check(&config->table) == FUZZY_OK &&
           fuzzy_table_check(&config->second_table) == FUZZY_OK;
}

static int limits_accepted(const assist_config *config)
{
    return config->market < MARKET_COUNT && not_negative(config->walk_speed_kmh) &&
           not_negative(config->assist_cutoff_extra_kmh) &&
           not_negative(config->assist_cutoff_kmh) &&
           not_negative(config->assist_cutoff_band_kmh) &&
           not_negative(config->motor_torque_nm_max) &&
           not_negative(config->battery_current_a_max) &&
           not_negative(config->battery_voltage_v_min) && not_negative(config->motor_speed_rpm_max);
}

int assist_config_check(const assist_config *config)
{
    if (!positive(config->step_s)) return ASSIST_CONFIG_REFUSED;
    if (!sensor_accepted(config) || !temperature_accepted(config) || !law_accepted(config) ||
        !limits_accepted(config)) {
        return ASSIST_CONFIG_REFUSED;
    }
    if (!positive(config->gear_ratio) || !positive(config->motor_torque_constant_nm_per_a) ||
        !positive(config->motor_resistance_ohm)) {
        return ASSIST_CONFIG_REFUSED;
    }
    return ASSIST_OK;
}

#include "config_law.h"

#include <string.h>

#define MS_PER_S 1000.0f
#define PCT_PER_WHOLE 100.0f
#define US_PER_S 1000000.0f

static void fuzzy_table_from(const ebl_config *config, fuzzy_table *table)
{
    memcpy(table->speed_points_kmh, config->fuzzy_speed_points_kmh, sizeof table->speed_points_kmh);
    memcpy(table->torque_rate_points, config->fuzzy_torque_rate_points,
           sizeof table->torque_rate_points);
    memcpy(table->gain_points, config->fuzzy_gain_points, sizeof table->gain_points);
    memcpy(table->rules, config->fuzzy_rules, sizeof table->rules);
    table->inference = config->fuzzy_inference;
}

/* The second table shares the points of the first. */
static void second_table_from(const ebl_config *config, fuzzy_table *table)
{
    fuzzy_table_from(config, table);
    memcpy(table->gain_points, config->second_gain_points, sizeof table->gain_points);
    memcpy(table->rules, config->second_rules, sizeof table->rules);
    table->inference = config->second_inference;
}

static void modes_from(const ebl_config *config, assist_config *assist)
{
    memcpy(assist->mode_laws, config->mode_laws, sizeof assist->mode_laws);
    memcpy(assist->mode_ratios, config->mode_ratios, sizeof assist->mode_ratios);
    memcpy(assist->mode_tapers, config->mode_tapers, sizeof assist->mode_tapers);
    memcpy(assist->mode_tables, config->mode_tables, sizeof assist->mode_tables);
    for (size_t slot = 0; slot < ASSIST_MODE_SLOTS; slot++) {
        assist->mode_ramp_up_nm_per_s[slot] = (float)config->mode_ramp_up_nm_per_s[slot];
        assist->mode_ramp_down_nm_per_s[slot] = (float)config->mode_ramp_down_nm_per_s[slot];
        assist->mode_torque_share[slot] = (float)config->mode_torque_pct[slot] / PCT_PER_WHOLE;
    }
}

void config_law_from(const ebl_config *config, assist_config *assist)
{
    memset(assist, 0, sizeof *assist);
    assist->step_s = (float)EBL_CONTROL_PERIOD_US / US_PER_S;
    assist->sensor_offset_counts = config->sensor_offset_counts;
    assist->sensor_gain_nm_per_count = config->sensor_gain_nm_per_count;
    assist->sensor_offset_counts_per_k = config->sensor_offset_counts_per_k;
    assist->sensor_gain_share_per_k = config->sensor_gain_share_per_k;
    assist->sensor_reference_degc = config->sensor_reference_degc;
    assist->torque_filter = config->torque_filter;
    assist->torque_filter_s = config->torque_filter_s;
    assist->torque_rate_interval_s = (float)config->torque_rate_interval_ms / MS_PER_S;
    assist->torque_rate_floor_nm = config->torque_rate_floor_nm;
    modes_from(config, assist);
    assist->fixed_taper_start_kmh = config->fixed_taper_start_kmh;
    assist->fixed_taper_end_kmh = config->fixed_taper_end_kmh;
    assist->assist_ramp_up_nm_per_s = config->assist_ramp_up_nm_per_s;
    assist->assist_ramp_down_nm_per_s = config->assist_ramp_down_nm_per_s;
    assist->pedal_torque_nm_min = config->pedal_torque_nm_min;
    fuzzy_table_from(config, &assist->table);
    second_table_from(config, &assist->second_table);
    assist->walk_speed_kmh = config->walk_speed_kmh;
    assist->market = config->market;
    assist->assist_cutoff_extra_kmh = config->assist_cutoff_extra_kmh;
    assist->fuzzy_falling_torque = config->fuzzy_falling_torque;
    assist->assist_cutoff_kmh = config->assist_cutoff_kmh;
    assist->assist_cutoff_band_kmh = config->assist_cutoff_band_kmh;
    assist->motor_torque_nm_max = config->motor_torque_nm_max;
    assist->battery_current_a_max = config->battery_current_a_max;
    assist->battery_voltage_v_min = config->battery_voltage_v_min;
    assist->motor_speed_rpm_max = config->motor_speed_rpm_max;
    assist->pedal_stop_s = (float)config->pedal_stop_ms / MS_PER_S;
    assist->gear_ratio = config->gear_ratio;
    assist->motor_torque_constant_nm_per_a = config->motor_torque_constant_nm_per_a;
    assist->motor_resistance_ohm = config->motor_resistance_ohm;
}

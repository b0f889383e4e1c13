/* Generated from registry.toml by `make gen`; change the registry, not this file. */
#include "ebl_registry.h"

#include <string.h>

#include "ebl_bytes.h" // ebl_get_f32, ebl_put_f32

const ebl_message ebl_messages[EBL_MESSAGE_COUNT] = {
    {0x0001, 14, 75},
    {0x0002, 0, 0},
    {0x0003, 6, 4},
    {0x0005, 0, 20},
    {0x0007, 0, 0},
    {0x0100, 0, 11},
    {0x0101, 5, 6},
    {0x0120, 8, 4},
    {0x0121, 2, 0},
    {0x0122, 2, 0},
    {0x0123, 2, 4},
    {0x0125, 8, 9},
    {0x0128, 2, 0},
    {0x0201, 6, 12},
    {0x0202, 1, 0},
    {0x0203, 2, 0},
    {0x0205, 0, 8},
    {0x0302, 0, 2},
    {0x7001, 0, 0},
    {0x7002, 0, 0},
};

const ebl_event_row ebl_event_rows[EBL_EVENT_COUNT] = {
    {EBL_EVENT_BOOT, 5},
    {EBL_EVENT_FAULT_SET, 2},
    {EBL_EVENT_FAULT_CLEARED, 2},
    {EBL_EVENT_CONFIG_COMMITTED, 8},
    {EBL_EVENT_CONFIG_ROLLED_BACK, 8},
    {EBL_EVENT_CONFIG_DEFAULTED, 8},
    {EBL_EVENT_STREAM_STATS, 9},
};

const ebl_parameter ebl_parameters[EBL_PARAMETER_COUNT] = {
    {0x0100, 0, EBL_TYPE_F32, 1, 4, EBL_ACCESS_DEALER, 0,
     -30000.0f, 30000.0f}, /* sensor_offset_counts */
    {0x0101, 4, EBL_TYPE_F32, 1, 4, EBL_ACCESS_DEALER, 0,
     0.001f, 0.1f}, /* sensor_gain_nm_per_count */
    {0x0102, 8, EBL_TYPE_F32, 1, 4, EBL_ACCESS_DEALER, 0,
     0.02f, 2.0f}, /* torque_filter_s */
    {0x0103, 12, EBL_TYPE_U16, 1, 2, EBL_ACCESS_DEALER, 0,
     10.0f, 500.0f}, /* torque_rate_interval_ms */
    {0x0104, 14, EBL_TYPE_F32, 1, 4, EBL_ACCESS_DEALER, 0,
     0.1f, 10.0f}, /* torque_rate_floor_nm */
    {0x0200, 18, EBL_TYPE_U8, 1, 1, EBL_ACCESS_DEALER, 0,
     0.0f, 4.0f}, /* assist_mode_at_start */
    {0x0201, 19, EBL_TYPE_TEXT, 5, 16, EBL_ACCESS_DEALER, 0,
     0.0f, 0.0f}, /* mode_names */
    {0x0202, 99, EBL_TYPE_U8, 5, 1, EBL_ACCESS_DEALER, 2,
     0.0f, 2.0f}, /* mode_laws */
    {0x0203, 104, EBL_TYPE_F32, 5, 4, EBL_ACCESS_DEALER, 0,
     0.0f, 3.0f}, /* mode_ratios */
    {0x0204, 124, EBL_TYPE_F32, 1, 4, EBL_ACCESS_DEALER, 0,
     0.0f, 25.0f}, /* fixed_taper_start_kmh */
    {0x0205, 128, EBL_TYPE_F32, 1, 4, EBL_ACCESS_DEALER, 0,
     0.0f, 25.0f}, /* fixed_taper_end_kmh */
    {0x0206, 132, EBL_TYPE_F32, 1, 4, EBL_ACCESS_DEALER, 0,
     5.0f, 2000.0f}, /* assist_ramp_up_nm_per_s */
    {0x0207, 136, EBL_TYPE_F32, 1, 4, EBL_ACCESS_DEALER, 0,
     20.0f, 2000.0f}, /* assist_ramp_down_nm_per_s */
    {0x0208, 140, EBL_TYPE_F32, 1, 4, EBL_ACCESS_DEALER, 0,
     0.0f, 20.0f}, /* pedal_torque_nm_min */
    {0x0300, 144, EBL_TYPE_TEXT, 1, 24, EBL_ACCESS_DEALER, 0,
     0.0f, 0.0f}, /* fuzzy_table_name */
    {0x0301, 168, EBL_TYPE_U8, 1, 1, EBL_ACCESS_DEALER, 2,
     0.0f, 1.0f}, /* fuzzy_inference */
    {0x0302, 169, EBL_TYPE_F32, 5, 4, EBL_ACCESS_DEALER, 1,
     0.0f, 45.0f}, /* fuzzy_speed_points_kmh */
    {0x0303, 189, EBL_TYPE_F32, 5, 4, EBL_ACCESS_DEALER, 1,
     0.0f, 5.0f}, /* fuzzy_torque_rate_points */
    {0x0304, 209, EBL_TYPE_F32, 5, 4, EBL_ACCESS_DEALER, 1,
     0.0f, 0.5f}, /* fuzzy_gain_points */
    {0x0305, 229, EBL_TYPE_U8, 25, 1, EBL_ACCESS_DEALER, 2,
     0.0f, 4.0f}, /* fuzzy_rules */
    {0x0306, 254, EBL_TYPE_U8, 1, 1, EBL_ACCESS_DEALER, 2,
     0.0f, 1.0f}, /* fuzzy_falling_torque */
    {0x0400, 255, EBL_TYPE_F32, 1, 4, EBL_ACCESS_DEALER, 0,
     0.0f, 25.0f}, /* assist_cutoff_kmh */
    {0x0401, 259, EBL_TYPE_F32, 1, 4, EBL_ACCESS_DEALER, 0,
     0.0f, 5.0f}, /* assist_cutoff_band_kmh */
    {0x0402, 263, EBL_TYPE_F32, 1, 4, EBL_ACCESS_DEALER, 0,
     0.0f, 2.0f}, /* motor_torque_nm_max */
    {0x0403, 267, EBL_TYPE_F32, 1, 4, EBL_ACCESS_DEALER, 0,
     1.0f, 12.0f}, /* battery_current_a_max */
    {0x0404, 271, EBL_TYPE_F32, 1, 4, EBL_ACCESS_DEALER, 0,
     24.0f, 40.0f}, /* battery_voltage_v_min */
    {0x0405, 275, EBL_TYPE_F32, 1, 4, EBL_ACCESS_DEALER, 0,
     500.0f, 3000.0f}, /* motor_speed_rpm_max */
    {0x0406, 279, EBL_TYPE_U16, 1, 2, EBL_ACCESS_DEALER, 0,
     50.0f, 1000.0f}, /* pedal_stop_ms */
    {0x0500, 281, EBL_TYPE_F32, 1, 4, EBL_ACCESS_FACTORY, 0,
     1.0f, 100.0f}, /* gear_ratio */
    {0x0501, 285, EBL_TYPE_U8, 1, 1, EBL_ACCESS_FACTORY, 0,
     10.0f, 80.0f}, /* chainring_teeth */
    {0x0502, 286, EBL_TYPE_U8, 1, 1, EBL_ACCESS_FACTORY, 0,
     8.0f, 60.0f}, /* cog_teeth */
    {0x0503, 287, EBL_TYPE_F32, 1, 4, EBL_ACCESS_FACTORY, 0,
     0.15f, 0.45f}, /* wheel_radius_m */
    {0x0510, 291, EBL_TYPE_F32, 1, 4, EBL_ACCESS_FACTORY, 0,
     0.01f, 1.0f}, /* motor_torque_constant_nm_per_a */
    {0x0511, 295, EBL_TYPE_F32, 1, 4, EBL_ACCESS_FACTORY, 0,
     0.01f, 2.0f}, /* motor_resistance_ohm */
};

const ebl_order ebl_orders[EBL_ORDER_COUNT] = {
    {124, 128, 0x0205, EBL_VIOLATION_TAPER_ORDER},
};

const ebl_channel ebl_channels[EBL_CHANNEL_COUNT] = {
    {1, 0.01f},
    {2, 0.01f},
    {3, 0.02f},
    {4, 0.01f},
    {5, 1.0f},
    {6, 0.01f},
    {7, 0.0005f},
    {8, 0.0001f},
    {9, 0.001f},
    {10, 0.1f},
    {11, 0.001f},
    {12, 0.002f},
    {13, 0.01f},
    {14, 0.0002f},
    {15, 5e-05f},
    {16, 1.0f},
    {17, 1.0f},
    {18, 0.01f},
    {19, 0.01f},
    {20, 1.0f},
};

const ebl_message *ebl_message_find(uint16_t id)
{
    for (size_t at = 0; at < EBL_MESSAGE_COUNT; at++) {
        if (ebl_messages[at].id == id) {
            return &ebl_messages[at];
        }
    }
    return NULL;
}

const ebl_event_row *ebl_event_find(uint8_t code)
{
    for (size_t at = 0; at < EBL_EVENT_COUNT; at++) {
        if (ebl_event_rows[at].code == code) {
            return &ebl_event_rows[at];
        }
    }
    return NULL;
}

const ebl_parameter *ebl_parameter_find(uint16_t id)
{
    for (size_t at = 0; at < EBL_PARAMETER_COUNT; at++) {
        if (ebl_parameters[at].id == id) {
            return &ebl_parameters[at];
        }
    }
    return NULL;
}

const ebl_channel *ebl_channel_find(uint8_t id)
{
    for (size_t at = 0; at < EBL_CHANNEL_COUNT; at++) {
        if (ebl_channels[at].id == id) {
            return &ebl_channels[at];
        }
    }
    return NULL;
}

void ebl_config_default(ebl_config *config)
{
    static const ebl_config factory = {
        .sensor_offset_counts = 0.0f,
        .sensor_gain_nm_per_count = 0.01f,
        .torque_filter_s = 0.5f,
        .torque_rate_interval_ms = 100,
        .torque_rate_floor_nm = 1.0f,
        .assist_mode_at_start = 3,
        .mode_names = {"off", "eco", "tour", "sport", "boost"},
        .mode_laws = {EBL_LAW_OFF, EBL_LAW_FIXED, EBL_LAW_FIXED, EBL_LAW_FUZZY, EBL_LAW_FUZZY},
        .mode_ratios = {0.0f, 0.5f, 1.0f, 1.0f, 1.5f},
        .fixed_taper_start_kmh = 15.0f,
        .fixed_taper_end_kmh = 24.0f,
        .assist_ramp_up_nm_per_s = 200.0f,
        .assist_ramp_down_nm_per_s = 400.0f,
        .pedal_torque_nm_min = 1.0f,
        .fuzzy_table_name = "thesis 4-2",
        .fuzzy_inference = EBL_INFERENCE_MAMDANI_CENTROID,
        .fuzzy_speed_points_kmh = {5.0f, 10.0f, 15.0f, 20.0f, 25.0f},
        .fuzzy_torque_rate_points = {0.0f, 0.225f, 0.45f, 0.675f, 0.9f},
        .fuzzy_gain_points = {0.1f, 0.2f, 0.3f, 0.4f, 0.5f},
        .fuzzy_rules = {
            {EBL_LABEL_ZO, EBL_LABEL_ZO, EBL_LABEL_PS, EBL_LABEL_PB, EBL_LABEL_PB},
            {EBL_LABEL_ZO, EBL_LABEL_ZO, EBL_LABEL_PS, EBL_LABEL_PS, EBL_LABEL_PB},
            {EBL_LABEL_NS, EBL_LABEL_ZO, EBL_LABEL_ZO, EBL_LABEL_PS, EBL_LABEL_PS},
            {EBL_LABEL_NB, EBL_LABEL_NS, EBL_LABEL_NS, EBL_LABEL_ZO, EBL_LABEL_ZO},
            {EBL_LABEL_NB, EBL_LABEL_NB, EBL_LABEL_NS, EBL_LABEL_NS, EBL_LABEL_NS}},
        .fuzzy_falling_torque = EBL_FALLING_TORQUE_HOLD_ZERO_RATE,
        .assist_cutoff_kmh = 25.0f,
        .assist_cutoff_band_kmh = 0.0f,
        .motor_torque_nm_max = 2.0f,
        .battery_current_a_max = 12.0f,
        .battery_voltage_v_min = 30.0f,
        .motor_speed_rpm_max = 3000.0f,
        .pedal_stop_ms = 150,
        .gear_ratio = 40.34f,
        .chainring_teeth = 44,
        .cog_teeth = 14,
        .wheel_radius_m = 0.33f,
        .motor_torque_constant_nm_per_a = 0.112f,
        .motor_resistance_ohm = 0.25f,
    };
    *config = factory;
}

void ebl_config_pack(const ebl_config *config, uint8_t *image)
{
    ebl_put_f32(image + 0, config->sensor_offset_counts);
    ebl_put_f32(image + 4, config->sensor_gain_nm_per_count);
    ebl_put_f32(image + 8, config->torque_filter_s);
    ebl_put_u16(image + 12, config->torque_rate_interval_ms);
    ebl_put_f32(image + 14, config->torque_rate_floor_nm);
    ebl_put_u8(image + 18, config->assist_mode_at_start);
    memcpy(image + 19, config->mode_names, 80);
    memcpy(image + 99, config->mode_laws, 5);
    for (size_t i = 0; i < 5; i++) {
        ebl_put_f32(image + 104 + 4 * i, config->mode_ratios[i]);
    }
    ebl_put_f32(image + 124, config->fixed_taper_start_kmh);
    ebl_put_f32(image + 128, config->fixed_taper_end_kmh);
    ebl_put_f32(image + 132, config->assist_ramp_up_nm_per_s);
    ebl_put_f32(image + 136, config->assist_ramp_down_nm_per_s);
    ebl_put_f32(image + 140, config->pedal_torque_nm_min);
    memcpy(image + 144, config->fuzzy_table_name, 24);
    ebl_put_u8(image + 168, config->fuzzy_inference);
    for (size_t i = 0; i < 5; i++) {
        ebl_put_f32(image + 169 + 4 * i, config->fuzzy_speed_points_kmh[i]);
    }
    for (size_t i = 0; i < 5; i++) {
        ebl_put_f32(image + 189 + 4 * i, config->fuzzy_torque_rate_points[i]);
    }
    for (size_t i = 0; i < 5; i++) {
        ebl_put_f32(image + 209 + 4 * i, config->fuzzy_gain_points[i]);
    }
    memcpy(image + 229, config->fuzzy_rules, 25);
    ebl_put_u8(image + 254, config->fuzzy_falling_torque);
    ebl_put_f32(image + 255, config->assist_cutoff_kmh);
    ebl_put_f32(image + 259, config->assist_cutoff_band_kmh);
    ebl_put_f32(image + 263, config->motor_torque_nm_max);
    ebl_put_f32(image + 267, config->battery_current_a_max);
    ebl_put_f32(image + 271, config->battery_voltage_v_min);
    ebl_put_f32(image + 275, config->motor_speed_rpm_max);
    ebl_put_u16(image + 279, config->pedal_stop_ms);
    ebl_put_f32(image + 281, config->gear_ratio);
    ebl_put_u8(image + 285, config->chainring_teeth);
    ebl_put_u8(image + 286, config->cog_teeth);
    ebl_put_f32(image + 287, config->wheel_radius_m);
    ebl_put_f32(image + 291, config->motor_torque_constant_nm_per_a);
    ebl_put_f32(image + 295, config->motor_resistance_ohm);
}

void ebl_config_unpack(ebl_config *config, const uint8_t *image)
{
    config->sensor_offset_counts = ebl_get_f32(image + 0);
    config->sensor_gain_nm_per_count = ebl_get_f32(image + 4);
    config->torque_filter_s = ebl_get_f32(image + 8);
    config->torque_rate_interval_ms = ebl_get_u16(image + 12);
    config->torque_rate_floor_nm = ebl_get_f32(image + 14);
    config->assist_mode_at_start = ebl_get_u8(image + 18);
    memcpy(config->mode_names, image + 19, 80);
    memcpy(config->mode_laws, image + 99, 5);
    for (size_t i = 0; i < 5; i++) {
        config->mode_ratios[i] = ebl_get_f32(image + 104 + 4 * i);
    }
    config->fixed_taper_start_kmh = ebl_get_f32(image + 124);
    config->fixed_taper_end_kmh = ebl_get_f32(image + 128);
    config->assist_ramp_up_nm_per_s = ebl_get_f32(image + 132);
    config->assist_ramp_down_nm_per_s = ebl_get_f32(image + 136);
    config->pedal_torque_nm_min = ebl_get_f32(image + 140);
    memcpy(config->fuzzy_table_name, image + 144, 24);
    config->fuzzy_inference = ebl_get_u8(image + 168);
    for (size_t i = 0; i < 5; i++) {
        config->fuzzy_speed_points_kmh[i] = ebl_get_f32(image + 169 + 4 * i);
    }
    for (size_t i = 0; i < 5; i++) {
        config->fuzzy_torque_rate_points[i] = ebl_get_f32(image + 189 + 4 * i);
    }
    for (size_t i = 0; i < 5; i++) {
        config->fuzzy_gain_points[i] = ebl_get_f32(image + 209 + 4 * i);
    }
    memcpy(config->fuzzy_rules, image + 229, 25);
    config->fuzzy_falling_torque = ebl_get_u8(image + 254);
    config->assist_cutoff_kmh = ebl_get_f32(image + 255);
    config->assist_cutoff_band_kmh = ebl_get_f32(image + 259);
    config->motor_torque_nm_max = ebl_get_f32(image + 263);
    config->battery_current_a_max = ebl_get_f32(image + 267);
    config->battery_voltage_v_min = ebl_get_f32(image + 271);
    config->motor_speed_rpm_max = ebl_get_f32(image + 275);
    config->pedal_stop_ms = ebl_get_u16(image + 279);
    config->gear_ratio = ebl_get_f32(image + 281);
    config->chainring_teeth = ebl_get_u8(image + 285);
    config->cog_teeth = ebl_get_u8(image + 286);
    config->wheel_radius_m = ebl_get_f32(image + 287);
    config->motor_torque_constant_nm_per_a = ebl_get_f32(image + 291);
    config->motor_resistance_ohm = ebl_get_f32(image + 295);
}

#include "parameters.h"

#include <string.h>

#include "ebl_bytes.h"  // ebl_get_u16, ebl_get_f32
#include "ebl_frame.h"  // ebl_crc32
#include "ebl_values.h" // ebl_image_violations

#define ITEM_HEADER_LENGTH 4
#define MS_PER_S 1000.0f
#define PCT_PER_WHOLE 100.0f
#define US_PER_S 1000000.0f
#define SPREAD_POINTS_MAX 32 /* more than all lists of points together */

typedef struct {
    const ebl_parameter *parameter;
    uint8_t first;
    uint8_t count;
    const uint8_t *values;
} item;

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

void parameters_to_assist(const ebl_config *config, assist_config *assist)
{
    memset(assist, 0, sizeof *assist);
    assist->step_s = (float)EBL_CONTROL_PERIOD_US / US_PER_S;
    assist->sensor_offset_counts = config->sensor_offset_counts;
    assist->sensor_gain_nm_per_count = config->sensor_gain_nm_per_count;
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

void parameters_default_image(uint8_t *image)
{
    ebl_config config;

    ebl_config_default(&config);
    ebl_config_pack(&config, image);
}

/* True if a value of this parameter may stand alone; order between values is VALIDATE's. */
static int value_is_in_range(const ebl_parameter *parameter, const uint8_t *bytes)
{
    float value;

    switch (parameter->type) {
    case EBL_TYPE_U8: value = (float)bytes[0]; break;
    case EBL_TYPE_U16: value = (float)ebl_get_u16(bytes); break;
    case EBL_TYPE_F32: value = ebl_get_f32(bytes); break;
    default: return 1;
    }
    /* Written so that NaN is out of range. */
    return value >= parameter->min && value <= parameter->max;
}

/* Reads one item. Its length in bytes goes to `used`. */
static uint8_t item_read(item *read, const uint8_t *bytes, size_t length, uint8_t access,
                         size_t *used, uint16_t *detail)
{
    size_t values_length;

    *detail = 0;
    if (length < ITEM_HEADER_LENGTH) return EBL_STATUS_LENGTH;
    *detail = ebl_get_u16(bytes);
    read->parameter = ebl_parameter_find(*detail);
    read->first = bytes[2];
    read->count = bytes[3];
    read->values = bytes + ITEM_HEADER_LENGTH;
    if (read->parameter == NULL) return EBL_STATUS_UNKNOWN_ID;
    if (read->parameter->access > access) {
        *detail = read->parameter->access;
        return EBL_STATUS_ACCESS;
    }
    if (read->count == 0 || read->first + read->count > read->parameter->count) {
        return EBL_STATUS_TYPE;
    }
    values_length = (size_t)read->count * read->parameter->length;
    if (length - ITEM_HEADER_LENGTH < values_length) return EBL_STATUS_LENGTH;
    for (size_t at = 0; at < values_length; at += read->parameter->length) {
        if (!value_is_in_range(read->parameter, read->values + at)) return EBL_STATUS_RANGE;
    }
    *used = ITEM_HEADER_LENGTH + values_length;
    return EBL_STATUS_OK;
}

uint8_t parameters_set(uint8_t *image, const uint8_t *items, size_t length, uint8_t access,
                       uint16_t *detail)
{
    item read;
    size_t used;

    for (size_t at = 0; at < length; at += used) {
        uint8_t status = item_read(&read, items + at, length - at, access, &used, detail);

        if (status != EBL_STATUS_OK) return status;
    }
    for (size_t at = 0; at < length; at += used) {
        (void)item_read(&read, items + at, length - at, access, &used, detail);
        memcpy(image + read.parameter->image_offset + (size_t)read.first * read.parameter->length,
               read.values, (size_t)read.count * read.parameter->length);
    }
    *detail = 0;
    return EBL_STATUS_OK;
}

uint8_t parameters_get(const uint8_t *image, const uint8_t *ids, size_t ids_length, uint8_t *items,
                       size_t capacity, size_t *items_length, uint16_t *detail)
{
    *items_length = 0;
    *detail = 0;
    if (ids_length % 2 != 0) return EBL_STATUS_LENGTH;
    for (size_t at = 0; at < ids_length; at += 2) {
        const ebl_parameter *parameter = ebl_parameter_find(ebl_get_u16(ids + at));
        uint8_t *next = items + *items_length;
        size_t values_length;

        *detail = ebl_get_u16(ids + at);
        if (parameter == NULL) return EBL_STATUS_UNKNOWN_ID;
        values_length = (size_t)parameter->count * parameter->length;
        if (capacity - *items_length < ITEM_HEADER_LENGTH + values_length) {
            return EBL_STATUS_NO_SPACE;
        }
        ebl_put_u16(next, parameter->id);
        next[2] = 0;
        next[3] = parameter->count;
        memcpy(next + ITEM_HEADER_LENGTH, image + parameter->image_offset, values_length);
        *items_length += ITEM_HEADER_LENGTH + values_length;
    }
    *detail = 0;
    return EBL_STATUS_OK;
}

static size_t row_spread(const ebl_parameter *row, uint8_t *bytes)
{
    size_t moved = 0;

    for (size_t i = 1; i < row->count; i++) {
        float least = ebl_get_f32(bytes + (i - 1) * row->length) + row->least_step;

        if (ebl_get_f32(bytes + i * row->length) >= least) continue;
        ebl_put_f32(bytes + i * row->length, least);
        moved++;
    }
    for (size_t i = row->count; i-- > 0;) {
        float most = row->max - row->least_step * (float)(row->count - 1 - i);

        if (ebl_get_f32(bytes + i * row->length) <= most) break;
        ebl_put_f32(bytes + i * row->length, most);
        moved++;
    }
    return moved;
}

size_t parameters_points_spread(uint8_t *image)
{
    ebl_refusal found[SPREAD_POINTS_MAX];
    size_t count = ebl_image_violations(image, found, SPREAD_POINTS_MAX);
    size_t moved = 0;

    if (count > SPREAD_POINTS_MAX) return 0;
    for (size_t i = 0; i < count; i++) {
        if (found[i].code != EBL_VIOLATION_NOT_INCREASING) return 0;
    }
    for (size_t i = 0; i < count; i++) {
        const ebl_parameter *row = ebl_parameter_find(found[i].id);

        if (i > 0 && found[i].id == found[i - 1].id) continue;
        moved += row_spread(row, image + row->image_offset);
    }
    return moved;
}

int parameters_image_is_valid(const uint8_t *image)
{
    ebl_config config;
    assist_config assist;

    if (ebl_image_violations(image, NULL, 0) > 0) return 0;
    ebl_config_unpack(&config, image);
    parameters_to_assist(&config, &assist);
    return assist_config_check(&assist) == ASSIST_OK;
}

#include "config_items.h"

#include <string.h>

#include "ebl_bytes.h"    // ebl_get_u16, ebl_put_f32
#include "ebl_values.h"   // ebl_element_is_allowed, ebl_image_violations
#include "config_image.h" // config_image_default, config_image_is_valid

/* Elements are read into a piece of this length; the longest is a table's name. */
#define ELEMENT_LENGTH_MAX 32

/* Putting one value right may put another wrong. */
#define SETTLE_ROUNDS_MAX 6
#define REFUSALS_AT_ONCE 6

#define MAKERS ((1u << EBL_RECORD_MARKET) | (1u << EBL_RECORD_FACTORY))

/* An item's elements, in flash at `address`. */
typedef struct {
    uint16_t id;
    uint8_t count;
    uint8_t length; /* of one */
    size_t address;
} config_item;

static void count_up(uint8_t *counter)
{
    if (*counter < UINT8_MAX) (*counter)++;
}

/* Of a number that was out of range: a u32 never is. */
static void number_put(const ebl_parameter *parameter, uint8_t *element, float value)
{
    switch (parameter->type) {
    case EBL_TYPE_U8: element[0] = (uint8_t)value; break;
    case EBL_TYPE_U16: ebl_put_u16(element, (uint16_t)value); break;
    default: ebl_put_f32(element, value);
    }
}

/* Puts the element that was read into the image. A choice this firmware does not have, and what is
 * no number, leave what is there. */
static void element_take(const ebl_parameter *parameter, uint8_t *element, uint8_t *place,
                         config_tally *tally)
{
    if (!ebl_element_is_allowed(parameter, element)) {
        float value = ebl_element_number(parameter, element);
        int is_choice = (parameter->flags & EBL_PARAMETER_CHOICE) != 0;

        count_up(&tally->clamped);
        if (parameter->id == EBL_PARAMETER_MARKET) tally->market_unknown = 1;
        if (is_choice || value != value) return;
        number_put(parameter, element, value < parameter->min ? parameter->min : parameter->max);
    }
    memcpy(place, element, parameter->length);
}

static void found_note(config_tally *tally, const ebl_parameter *parameter)
{
    size_t row = (size_t)(parameter - ebl_parameters);

    tally->found[row / 8] |= (uint8_t)(1u << row % 8);
}

static int is_found(const config_tally *tally, uint16_t id)
{
    const ebl_parameter *parameter = ebl_parameter_find(id);
    size_t row = (size_t)(parameter - ebl_parameters);

    return (tally->found[row / 8] >> row % 8 & 1u) != 0;
}

/* Its value becomes the image's, as near as this firmware allows. Negative where the flash cannot
 * be read. */
static int value_read(const hal *board, const config_item *item, uint8_t *image,
                      config_tally *tally)
{
    const ebl_parameter *parameter = ebl_parameter_find(item->id);
    uint8_t element[ELEMENT_LENGTH_MAX];

    if (parameter == NULL || parameter->length != item->length ||
        parameter->length > sizeof element) {
        count_up(&tally->dropped);
        return 0;
    }
    found_note(tally, parameter);
    if (item->count != parameter->count) count_up(&tally->clamped);
    for (size_t i = 0; i < item->count && i < parameter->count; i++) {
        size_t at = i * parameter->length;

        if (board->flash_read(board->context, item->address + at, element, parameter->length) < 0) {
            return -1;
        }
        element_take(parameter, element, image + parameter->image_offset + at, tally);
    }
    return 0;
}

int config_items_read(const hal *board, size_t address, size_t length, uint8_t *image,
                      config_tally *tally)
{
    size_t at = 0;

    while (at < length) {
        uint8_t head[CONFIG_ITEM_HEAD_LENGTH];
        config_item item;
        size_t values_length;

        if (length - at < sizeof head) return -1;
        if (board->flash_read(board->context, address + at, head, sizeof head) < 0) return -1;
        at += sizeof head;
        values_length = (size_t)head[2] * head[3];
        if (length - at < values_length) return -1;
        item.id = ebl_get_u16(head);
        item.count = head[2];
        item.length = head[3];
        item.address = address + at;
        if (value_read(board, &item, image, tally) < 0) return -1;
        at += values_length;
    }
    return 0;
}

void config_sensor_as_drawn(ebl_config *config)
{
    config->sensor_offset_counts_per_k = 2.0f;
    config->sensor_gain_share_per_k = -2e-4f;
    config->sensor_reference_degc = 20.0f;
}

static void sensor_as_drawn(uint8_t *image)
{
    ebl_config config;

    ebl_config_unpack(&config, image);
    config_sensor_as_drawn(&config);
    ebl_config_pack(&config, image);
}

void config_items_account(uint8_t *image, config_tally *tally, uint8_t records)
{
    /* Firmware without these parameters corrected every reading for a sensor as drawn. */
    if (is_found(tally, EBL_PARAMETER_SENSOR_GAIN_NM_PER_COUNT) &&
        !is_found(tally, EBL_PARAMETER_SENSOR_REFERENCE_DEGC)) {
        sensor_as_drawn(image);
    }
    for (size_t i = 0; i < EBL_BAND_COUNT; i++) {
        const ebl_band *band = &ebl_bands[i];

        if (!is_found(tally, band->id) || is_found(tally, band->around_id)) continue;
        if ((records & MAKERS) != MAKERS) continue;
        memcpy(image + band->around_offset, image + band->offset, sizeof(float));
    }
    for (size_t row = 0; row < EBL_PARAMETER_COUNT; row++) {
        if ((tally->found[row / 8] >> row % 8 & 1u) != 0) continue;
        if ((records >> ebl_parameters[row].record & 1u) != 0) count_up(&tally->added);
    }
}

static void default_put(uint8_t *image, const uint8_t *defaults, const ebl_parameter *parameter)
{
    memcpy(image + parameter->image_offset, defaults + parameter->image_offset,
           (size_t)parameter->count * parameter->length);
}

/* The one that was refused, and what it is in order with. */
static void refused_default(uint8_t *image, const uint8_t *defaults, uint16_t id)
{
    const ebl_parameter *refused = ebl_parameter_find(id);

    if (refused != NULL) default_put(image, defaults, refused);
    for (size_t i = 0; i < EBL_ORDER_COUNT; i++) {
        if (ebl_orders[i].high_id != id) continue;
        for (size_t row = 0; row < EBL_PARAMETER_COUNT; row++) {
            if (ebl_parameters[row].image_offset != ebl_orders[i].low_offset) continue;
            default_put(image, defaults, &ebl_parameters[row]);
        }
    }
}

/* Not inlined: its image must not lie on the stack beneath the checks of the law, the deepest. */
__attribute__((noinline)) static void refused_settle(uint8_t *image, config_tally *tally)
{
    ebl_refusal found[REFUSALS_AT_ONCE];
    uint8_t defaults[EBL_IMAGE_LENGTH];

    config_image_default(defaults);
    for (int round = 0; round < SETTLE_ROUNDS_MAX; round++) {
        size_t count = ebl_image_violations(image, found, REFUSALS_AT_ONCE);

        if (count == 0) break;
        for (size_t i = 0; i < count && i < REFUSALS_AT_ONCE; i++) {
            refused_default(image, defaults, found[i].id);
            count_up(&tally->clamped);
        }
    }
}

int config_items_settle(uint8_t *image, config_tally *tally)
{
    if (config_image_points_spread(image) > 0) count_up(&tally->clamped);
    if (config_image_is_valid(image)) return 1;
    refused_settle(image, tally);
    return config_image_is_valid(image);
}

void config_items_default(uint8_t *image, uint8_t records)
{
    uint8_t defaults[EBL_IMAGE_LENGTH];

    config_image_default(defaults);
    for (size_t row = 0; row < EBL_PARAMETER_COUNT; row++) {
        if ((records >> ebl_parameters[row].record & 1u) == 0) continue;
        default_put(image, defaults, &ebl_parameters[row]);
    }
    if ((records >> EBL_RECORD_CALIBRATION & 1u) != 0) sensor_as_drawn(image);
    if ((records >> EBL_RECORD_FACTORY & 1u) != 0) return;
    for (size_t i = 0; i < EBL_BAND_COUNT; i++) {
        if ((records >> ebl_parameter_find(ebl_bands[i].id)->record & 1u) == 0) continue;
        memcpy(image + ebl_bands[i].offset, image + ebl_bands[i].around_offset, sizeof(float));
    }
}

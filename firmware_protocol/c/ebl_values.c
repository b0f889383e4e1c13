/* The unit's own check of a configuration: the host's check is never trusted. */
#include "ebl_values.h"

#include "ebl_bytes.h" // ebl_get_f32

#define NO_VIOLATION 0
#define COUNT_MAX 32767.0f /* what a value beyond the range of its channel becomes */
#define STEP_SHARE 0.99f   /* decimals a least step apart may be nearer as float32 */

static int is_finite(float value) { return value - value == 0.0f; }

int16_t ebl_channel_counts(float scale, float value)
{
    float counts = value / scale;
    if (__builtin_fabsf(counts) < COUNT_MAX) {
        return (int16_t)(counts < 0.0f ? counts - 0.5f : counts + 0.5f);
    }
    if (!is_finite(value) || counts != counts) {
        return EBL_MISSING;
    }
    return (int16_t)(counts > 0.0f ? COUNT_MAX : -COUNT_MAX);
}

typedef struct {
    ebl_refusal *found;
    size_t capacity;
    size_t count;
} refusals;

static void refuse(refusals *list, uint16_t id, size_t index, uint8_t code)
{
    if (list->count < list->capacity) {
        ebl_refusal refusal = {id, (uint8_t)index, code};
        list->found[list->count] = refusal;
    }
    list->count++;
}

/* Bytes of the UTF-8 sequence that starts here, 0 if it is not one (RFC 3629, table of clause 4:
 * no overlong forms, no surrogates, nothing above U+10FFFF). */
static size_t utf8_sequence(const uint8_t *text, size_t left)
{
    uint8_t first = text[0];
    uint8_t low = first == 0xe0u ? 0xa0u : first == 0xf0u ? 0x90u : 0x80u;
    uint8_t high = first == 0xedu ? 0x9fu : first == 0xf4u ? 0x8fu : 0xbfu;
    size_t length = first < 0x80u ? 1 : first < 0xe0u ? 2 : first < 0xf0u ? 3 : 4;

    if ((first >= 0x80u && first < 0xc2u) || first > 0xf4u || length > left) {
        return 0;
    }
    for (size_t at = 1; at < length; at++) {
        if (text[at] < low || text[at] > high) {
            return 0;
        }
        low = 0x80u;
        high = 0xbfu;
    }
    return length;
}

/* UTF-8 without control characters, then nothing but zeros. */
static int is_text(const uint8_t *text, size_t length)
{
    size_t at = 0;
    while (at < length && text[at] != 0) {
        size_t step = utf8_sequence(text + at, length - at);
        if (step == 0 || text[at] < 0x20u || text[at] == 0x7fu) {
            return 0;
        }
        at += step;
    }
    while (at < length && text[at] == 0) {
        at++;
    }
    return at == length;
}

float ebl_element_number(const ebl_parameter *parameter, const uint8_t *element)
{
    switch (parameter->type) {
    case EBL_TYPE_U8: return (float)ebl_get_u8(element);
    case EBL_TYPE_U16: return (float)ebl_get_u16(element);
    case EBL_TYPE_U32: return (float)ebl_get_u32(element);
    default: return ebl_get_f32(element);
    }
}

static int is_none(const ebl_parameter *parameter, const uint8_t *element)
{
    return (parameter->flags & EBL_PARAMETER_NONE) != 0 && ebl_get_u32(element) == EBL_NONE_BITS;
}

/* Written so that a NaN is out of range. */
int ebl_element_is_allowed(const ebl_parameter *parameter, const uint8_t *element)
{
    float value;

    if (parameter->type == EBL_TYPE_TEXT || is_none(parameter, element)) {
        return 1;
    }
    value = ebl_element_number(parameter, element);
    return value >= parameter->min && value <= parameter->max;
}

static uint8_t range_violation(const ebl_parameter *parameter, float value)
{
    if (!is_finite(value)) {
        return EBL_VIOLATION_NOT_FINITE;
    }
    if ((parameter->flags & EBL_PARAMETER_CHOICE) != 0) {
        return value > parameter->max ? EBL_VIOLATION_NOT_A_CHOICE : NO_VIOLATION;
    }
    if (value < parameter->min) {
        return EBL_VIOLATION_BELOW_MIN;
    }
    return value > parameter->max ? EBL_VIOLATION_ABOVE_MAX : NO_VIOLATION;
}

static void parameter_check(const ebl_parameter *parameter, const uint8_t *bytes, refusals *list)
{
    float before = 0.0f;
    for (size_t index = 0; index < parameter->count; index++) {
        const uint8_t *element = bytes + index * parameter->length;
        if (parameter->type == EBL_TYPE_TEXT) {
            if (!is_text(element, parameter->length)) {
                refuse(list, parameter->id, index, EBL_VIOLATION_NOT_TEXT);
            }
            continue;
        }
        if (is_none(parameter, element)) {
            continue;
        }
        float value = ebl_element_number(parameter, element);
        uint8_t code = range_violation(parameter, value);
        int rises = (parameter->flags & EBL_PARAMETER_INCREASING) != 0 && index > 0;
        if (code == NO_VIOLATION && rises && value - before < STEP_SHARE * parameter->least_step) {
            code = EBL_VIOLATION_NOT_INCREASING;
        }
        if (code != NO_VIOLATION) {
            refuse(list, parameter->id, index, code);
        }
        before = value;
    }
}

size_t ebl_image_violations(const uint8_t *image, ebl_refusal *found, size_t capacity)
{
    refusals list = {found, capacity, 0};
    for (size_t at = 0; at < EBL_PARAMETER_COUNT; at++) {
        parameter_check(&ebl_parameters[at], image + ebl_parameters[at].image_offset, &list);
    }
    for (size_t at = 0; at < EBL_ORDER_COUNT; at++) {
        float low = ebl_get_f32(image + ebl_orders[at].low_offset);
        float high = ebl_get_f32(image + ebl_orders[at].high_offset);
        if (low >= high) {
            refuse(&list, ebl_orders[at].high_id, 0, ebl_orders[at].violation);
        }
    }
    return list.count;
}

size_t ebl_config_violations(const ebl_config *config, ebl_refusal *found, size_t capacity)
{
    uint8_t image[EBL_IMAGE_LENGTH];
    ebl_config_pack(config, image);
    return ebl_image_violations(image, found, capacity);
}

/* Written so that what is no number does not hold. */
int ebl_band_holds(const ebl_band *band, const uint8_t *image)
{
    float around = ebl_get_f32(image + band->around_offset);
    float distance = ebl_get_f32(image + band->offset) - around;
    float within = band->within;

    if (band->scale_offset != EBL_BAND_NO_SCALE) {
        distance *= ebl_get_f32(image + band->scale_offset);
    }
    if (band->share > 0.0f) {
        within = band->share * (around < 0.0f ? -around : around);
    }
    return (distance < 0.0f ? -distance : distance) <= within;
}

#include "parameters.h"

#include <string.h>

#include "ebl_bytes.h"  // ebl_get_u16
#include "ebl_values.h" // ebl_element_is_allowed

#define ITEM_HEADER_LENGTH 4

typedef struct {
    const ebl_parameter *parameter;
    uint8_t first;
    uint8_t count;
    const uint8_t *values;
} item;

/* Reads one item. Its length in bytes goes to `used`. Order between values is VALIDATE's. */
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
        if (!ebl_element_is_allowed(read->parameter, read->values + at)) return EBL_STATUS_RANGE;
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

/* The configuration as the host writes and reads it: items of an image. */
#ifndef SPINDLE_PARAMETERS_H
#define SPINDLE_PARAMETERS_H

#include <stddef.h>
#include <stdint.h>

#include "ebl_registry.h" // ebl_status

/* Writes the items of CFG_SET (id u16, first index u8, count u8, values) into the image: all, or
 * none. Returns an ebl_status; `detail` then is the parameter's id, or for ACCESS the level that
 * is needed. */
uint8_t parameters_set(uint8_t *image, const uint8_t *items, size_t length, uint8_t access,
                       uint16_t *detail);

/* The items of the parameters whose ids (u16) are listed, whole. NO_SPACE where they do not fit;
 * `detail` then is the id. */
uint8_t parameters_get(const uint8_t *image, const uint8_t *ids, size_t ids_length, uint8_t *items,
                       size_t capacity, size_t *items_length, uint16_t *detail);

#endif

/* The configuration as the host writes it (items into an image) and as the law wants it. */
#ifndef SPINDLE_PARAMETERS_H
#define SPINDLE_PARAMETERS_H

#include <stddef.h>
#include <stdint.h>

#include "assist.h"       // assist_config
#include "ebl_registry.h" // ebl_config, ebl_status

/* The law's view of a configuration; `step_s` is the control period. */
void parameters_to_assist(const ebl_config *config, assist_config *assist);

/* The factory default as an image. */
void parameters_default_image(uint8_t *image);

/* An image whose only fault is that points are nearer than their least step, as firmware without
 * that rule took them: moves each just far enough from the one before it, and back from the end of
 * the range. Any other image stays as it is. Returns how many points were moved. */
size_t parameters_points_spread(uint8_t *image);

/* True if every value is within its range and the law accepts the whole. */
int parameters_image_is_valid(const uint8_t *image);

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
